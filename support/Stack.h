// Room on the stack, whatever limits the process was started with.
#pragma once

namespace dotek {

// What `main` does once there is room: gives the exit status.
using MainWork = int (*)(int argc, char** argv);

// Runs `work` with 8 MB of stack, and gives as much to each thread that is started from now on. Where `ulimit
// -s` leaves less, the limit is raised, else `work` runs on a thread of its own. -1: there is no room for
// one.
int runWithStack(MainWork work, int argc, char** argv);

} // namespace dotek
