#include "support/Stack.h"

#include <pthread.h>
#include <sys/resource.h>

namespace dotek {
namespace {

constexpr std::size_t kStack = std::size_t{8}
                               << 20; // what systems give by default, and what limits are set for

struct Call {
  MainWork work;
  int argc;
  char** argv;
  int status;
};

void* run(void* argument) {
  Call& call = *static_cast<Call*>(argument);
  call.status = call.work(call.argc, call.argv);
  return nullptr;
}

// The stack of the first thread grows up to the limit that is in force as it grows.
bool hasRoom() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0) return true; // nobody knows of a limit
  if (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= kStack) return true;
  limit.rlim_cur = kStack;
  if (limit.rlim_max != RLIM_INFINITY && limit.rlim_max < kStack) return false;
  return setrlimit(RLIMIT_STACK, &limit) == 0;
}

} // namespace

int runWithStack(MainWork work, int argc, char** argv) {
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return -1;
  pthread_attr_setstacksize(&attributes, kStack);
  pthread_setattr_default_np(&attributes);
  int status = -1;
  if (hasRoom()) {
    status = work(argc, argv);
  } else {
    Call call{work, argc, argv, -1};
    pthread_t thread{};
    if (pthread_create(&thread, &attributes, run, &call) == 0 && pthread_join(thread, nullptr) == 0)
      status = call.status;
  }
  pthread_attr_destroy(&attributes);
  return status;
}

} // namespace dotek
