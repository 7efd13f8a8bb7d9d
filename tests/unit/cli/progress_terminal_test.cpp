// The display of progress on a terminal, which appears nowhere else.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <string>

#include "cli/terminal/progress.h"

namespace medial_vk::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// Standard error is a terminal of its own during the life of this object.
class Terminal {
 public:
  Terminal() : screen_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)), before_(::dup(STDERR_FILENO)) {
    if (screen_ < 0 || ::grantpt(screen_) != 0 || ::unlockpt(screen_) != 0) return;
    const int line = ::open(::ptsname(screen_), O_RDWR | O_NOCTTY);
    if (line < 0) return;
    is_open_ = ::dup2(line, STDERR_FILENO) == STDERR_FILENO;
    ::close(line);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
    ::close(screen_);
  }

  bool is_open() const { return is_open_; }

  /// The output since the last call.
  std::string shown() const {
    std::string text(4096, '\0');
    const ssize_t got = ::read(screen_, text.data(), text.size());
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
  }

 private:
  int screen_, before_;
  bool is_open_ = false;
};

TEST(ProgressOnATerminal, OneLineThatIsReplacedAndRemoved) {
  const Terminal terminal;
  if (!terminal.is_open()) GTEST_SKIP() << "no pseudo terminal is available";
  {
    Progress progress(true);
    progress.update("extract", 0.25);
    EXPECT_THAT(terminal.shown(), HasSubstr("\rextract    [========"));
    progress.update("extract", 0.26);  // at most ten a second
    EXPECT_EQ(terminal.shown(), "");
    progress.update("certify", 0.5);  // but a new stage at once
    const std::string second = terminal.shown();
    EXPECT_THAT(second, HasSubstr("certify"));
    EXPECT_THAT(second, HasSubstr("50 %"));
    EXPECT_THAT(second, Not(HasSubstr("\n")));
    progress.clear();
    EXPECT_THAT(terminal.shown(), EndsWith("\r\033[K"));
    progress.clear();  // nothing is left to remove
    EXPECT_EQ(terminal.shown(), "");
    progress.update("write", 1);
    EXPECT_THAT(terminal.shown(), HasSubstr("100 %"));
  }
  EXPECT_THAT(terminal.shown(), EndsWith("\r\033[K"));
}

TEST(ProgressOnATerminal, NothingIfItIsNotWanted) {
  const Terminal terminal;
  if (!terminal.is_open()) GTEST_SKIP() << "no pseudo terminal is available";
  Progress progress(false);
  progress.update("extract", 0.5);
  progress.clear();
  EXPECT_EQ(terminal.shown(), "");
}

}  // namespace
}  // namespace medial_vk::cli
