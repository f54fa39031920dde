// gnuplot, which draws the plots: a process of its own for each.
#pragma once

#include <string>

namespace vsglbench {

class Gnuplot {
 public:
  // Throws Error(output), naming the package, where gnuplot is not installed.
  Gnuplot();
  const std::string& version() const { return version_; }  // "5.4"

  // What it writes to its standard output. Throws Error(output) "gnuplot: ..." with what it says is wrong.
  std::string run(const std::string& script) const;

  // Text as a string of the script. Nothing in it is a command or an escape: gnuplot takes what stands
  // between single quotes as it is, and a quote of the text, which it would not always take, becomes ’.
  static std::string quoted(const std::string& text);

 private:
  std::string version_;
};

}  // namespace vsglbench
