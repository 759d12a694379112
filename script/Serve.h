// The worker's side: what a program does that is started to run scripts.
#pragma once

namespace dotek::script {

// Answers a Runner until it is gone; the exit status of the program. 2: the program was not started by a
// Runner, which is said on standard error.
int serve();

} // namespace dotek::script
