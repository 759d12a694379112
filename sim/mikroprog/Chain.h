// A program that G28 runs: what it finds, and what is there when it has come back (T353-357). What of the
// state survives is not stated (Q25), so a run goes on only where that makes no difference. Private to this
// room.
#pragma once

#include "sim/machine/Bytecode.h"
#include "stdlib/MikroprogControl.h"

#include <memory>
#include <vector>

namespace dotek::sim::mikroprog {

// Of a run: the programs that are open.
class Chain {
public:
  // `assumed`: the profile answers Q25, and the state is that of the caller, both ways.
  Chain(const stdlib::MikroprogControl& control, bool assumed) : control_(control), assumed_(assumed) {}

  bool enter(Machine& machine, double* cells); // G28; false: the run has ended, as below
  bool leave(Machine& machine, double* cells); // the end of what it runs
  void call() { ++calls_; }                    // G26
  void comeBack() {                            // M17
    if (calls_ > 0) --calls_;
  }

private:
  struct Open {
    std::vector<double> parameters; // of the caller
    std::uint32_t calls = 0;        // subprograms that are open in it
  };
  bool isAsAtStart(Machine& machine, double* cells, bool leaving) const;

  const stdlib::MikroprogControl& control_;
  bool assumed_;
  std::vector<Open> open_;
  std::uint32_t calls_ = 0;
};

} // namespace dotek::sim::mikroprog
