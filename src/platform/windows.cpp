// All that this program asks of Windows.
// long: everything of Win32 is in this file, so that no other one includes its header.
#if !defined(NOMINMAX)
#define NOMINMAX
#endif
#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <sys/stat.h>
// This one before the next.
#include <windows.h>

#include <shellapi.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <thread>

#include "platform/files.h"
#include "platform/libraries.h"
#include "platform/machine.h"
#include "platform/paths.h"
#include "platform/processes.h"
#include "platform/signals.h"
#include "platform/terminal.h"

namespace medial_vk::platform {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string utf8_of(std::wstring_view text) { return platform::utf8_of(std::u16string(text.begin(), text.end())); }

std::wstring wide(std::string_view text) { return path_of(text).wstring(); }

/// With the prefix that calls of Win32 need for paths of more than 259 characters.
std::wstring wide_path(const std::string& text) {
  constexpr std::size_t kLongest = 240;  // less than MAX_PATH, since names are appended
  std::error_code error;
  const fs::path given = path_of(text);
  const bool has_prefix = text.size() >= 4 && text.find_first_not_of("/\\") == 2 &&
                          (text[2] == '?' || text[2] == '.') && (text[3] == '/' || text[3] == '\\');
  if (text == "NUL" || has_prefix) return given.wstring();
  std::wstring whole = fs::absolute(given, error).lexically_normal().make_preferred().wstring();
  if (error || whole.size() < kLongest) return given.wstring();
  return whole.starts_with(L"\\\\") ? L"\\\\?\\UNC" + whole.substr(1) : L"\\\\?\\" + whole;
}

/// The reason of the last call, as a number of errno.
int last_reason() {
  const DWORD code = ::GetLastError();
  if (code == ERROR_SHARING_VIOLATION || code == ERROR_USER_MAPPED_FILE) return EACCES;
  if (code == ERROR_DIRECTORY || code == ERROR_PATH_NOT_FOUND) return ENOENT;
  if (code == ERROR_NO_DATA || code == ERROR_BROKEN_PIPE) return EPIPE;
  if (code == ERROR_DISK_FULL || code == ERROR_HANDLE_DISK_FULL) return ENOSPC;
  if (code == ERROR_WRITE_PROTECT) return EROFS;
  const std::error_condition same = std::system_category().default_error_condition(static_cast<int>(code));
  return same.category() == std::generic_category() && same.value() != 0 ? same.value() : EINVAL;
}

HANDLE handle_of(std::intptr_t number) { return reinterpret_cast<HANDLE>(number); }
std::intptr_t number_of(HANDLE handle) { return reinterpret_cast<std::intptr_t>(handle); }

/// A handle that is closed at the end.
class Handle {
 public:
  explicit Handle(HANDLE handle = INVALID_HANDLE_VALUE) : handle_(handle) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }
  HANDLE get() const { return handle_; }
  HANDLE* put() { return &handle_; }
  bool is_open() const { return handle_ != INVALID_HANDLE_VALUE && handle_ != nullptr; }
  void close() {
    if (is_open()) ::CloseHandle(handle_);
    handle_ = INVALID_HANDLE_VALUE;
  }

 private:
  HANDLE handle_;
};

bool write_handle(HANDLE handle, std::string_view bytes) {
  constexpr std::size_t kPart = 1u << 20;  // pipes and consoles refuse much more at a time
  while (!bytes.empty()) {
    DWORD written = 0;
    if (::WriteFile(handle, bytes.data(), static_cast<DWORD>(std::min(bytes.size(), kPart)), &written, nullptr) == 0) {
      errno = last_reason();
      return false;
    }
    bytes.remove_prefix(written);
  }
  return true;
}

/// A console takes UTF-16 whatever its code page, which other programs use, too, and which therefore stays.
bool write_console(HANDLE console, std::string_view utf8) {
  constexpr std::size_t kPart = 8192;  // units: older systems refuse much more than 64 KiB at a time
  const std::wstring text = wide(utf8);
  for (std::wstring_view left = text; !left.empty();) {
    DWORD written = 0;
    if (::WriteConsoleW(console, left.data(), static_cast<DWORD>(std::min(left.size(), kPart)), &written, nullptr) ==
        0) {
      errno = last_reason();
      return false;
    }
    left.remove_prefix(written);
  }
  return true;
}

HANDLE open_handle(const std::wstring& path, DWORD access, DWORD how, DWORD flags = FILE_ATTRIBUTE_NORMAL) {
  constexpr DWORD kShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  return ::CreateFileW(path.c_str(), access, kShare, nullptr, how, flags, nullptr);
}

std::string folder_of(const std::string& path) {
  const fs::path folder = path_of(path).parent_path();
  return folder.empty() ? "." : text_of(folder);
}

/// The file behind `path` if it is a symbolic link to an existing one, else `path`.
std::string follow_links(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path_of(path), error)) return path;
  const fs::path real = fs::canonical(path_of(path), error);
  return error ? path : text_of(real);
}

bool is_device(const std::string& path) {
  const Handle file(open_handle(wide_path(path), FILE_READ_ATTRIBUTES, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS));
  return file.is_open() && ::GetFileType(file.get()) != FILE_TYPE_DISK;
}

std::string random_name(const std::string& folder) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::string name = folder + "/.medial-vk.";
  std::random_device random;
  for (int i = 0; i < 6; ++i) name += kLetters[random() % kLetters.size()];
  return name;
}

/// A new file beside others in a folder; its name in `name`.
HANDLE make_temporary(const std::string& folder, std::string& name, DWORD flags) {
  constexpr int kTries = 100;
  for (int i = 0;; ++i) {
    name = random_name(folder);
    const HANDLE file = open_handle(wide_path(name), GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW, flags);
    if (file != INVALID_HANDLE_VALUE || ::GetLastError() != ERROR_FILE_EXISTS || i == kTries) return file;
  }
}

/// Whether the file is deleted when its last handle is closed, as at the end of the process.
bool set_deleted_at_end(HANDLE file, bool is_deleted) {
  FILE_DISPOSITION_INFO info = {};
  info.DeleteFile = is_deleted ? TRUE : FALSE;
  return ::SetFileInformationByHandle(file, FileDispositionInfo, &info, sizeof info) != 0;
}

/// The class of characters at the beginning of `pattern`, behind its bracket: whether `c` is in it, and its length with
/// the closing bracket; 0: it has none, and the bracket stands for itself.
std::size_t read_class(std::string_view pattern, char c, bool& is_in) {
  const bool is_negated = pattern.starts_with('!') || pattern.starts_with('^');
  is_in = false;
  const std::size_t first = is_negated ? 1 : 0;
  for (std::size_t i = first; i < pattern.size(); ++i) {
    if (pattern[i] == ']' && i > first) {
      is_in = is_in != is_negated;
      return i + 1;
    }
    const bool is_range = i + 2 < pattern.size() && pattern[i + 1] == '-' && pattern[i + 2] != ']';
    const char last = is_range ? pattern[i + 2] : pattern[i];
    is_in = is_in || (pattern[i] <= c && c <= last);
    if (is_range) i += 2;
  }
  return 0;
}

bool matches(std::string_view name, std::string_view pattern) {
  for (; !pattern.empty() && pattern[0] != '*'; name.remove_prefix(1)) {
    if (name.empty()) return false;
    bool is_in = pattern[0] == '?' || pattern[0] == name[0];
    std::size_t length = 1;
    if (pattern[0] == '[') {
      bool is_in_class = false;
      const std::size_t behind = read_class(pattern.substr(1), name[0], is_in_class);
      if (behind > 0) is_in = is_in_class;
      length += behind;
    }
    if (!is_in) return false;
    pattern.remove_prefix(length);
  }
  if (pattern.empty()) return name.empty();
  for (std::size_t i = 0; i <= name.size(); ++i) {
    if (matches(name.substr(i), pattern.substr(1))) return true;
  }
  return false;
}

// ---- Children.

constexpr const wchar_t* kReplay = L"MEDIAL_VK_CHILD";

std::wstring variable(const wchar_t* name) {
  const wchar_t* const value = ::_wgetenv(name);
  return value != nullptr ? value : L"";
}

void append_text(std::string& out, std::string_view text) {
  const std::uint64_t length = text.size();
  out.append(reinterpret_cast<const char*>(&length), sizeof length);
  out += text;
}

std::string take_text(std::string_view& bytes) {
  std::uint64_t length = 0;
  if (bytes.size() < sizeof length) return {};
  std::memcpy(&length, bytes.data(), sizeof length);
  bytes.remove_prefix(sizeof length);
  const std::string text(bytes.substr(0, static_cast<std::size_t>(length)));
  bytes.remove_prefix(std::min(text.size(), bytes.size()));
  return text;
}

std::string encode_outcome(const ChildOutcome& outcome) {
  std::string out(1, static_cast<char>(outcome.end));
  for (const std::string* text : {&outcome.how, &outcome.result, &outcome.messages}) append_text(out, *text);
  return out;
}

std::string read_to_end(HANDLE file) {
  std::string bytes;
  std::array<char, 1 << 16> part;
  for (DWORD count = 0;
       ::ReadFile(file, part.data(), static_cast<DWORD>(part.size()), &count, nullptr) != 0 && count > 0;) {
    bytes.append(part.data(), count);
  }
  return bytes;
}

/// The outcomes of the calls of run_in_child() so far; in a child, at first those that its parent has had, and where
/// its result goes.
struct Calls {
  std::vector<ChildOutcome> known;
  std::size_t made = 0;
  HANDLE result = INVALID_HANDLE_VALUE;
};

Calls begin_calls() {
  Calls calls;
  const std::wstring handles = variable(kReplay);
  if (handles.empty()) return calls;
  wchar_t* end = nullptr;
  const HANDLE known = handle_of(static_cast<std::intptr_t>(std::wcstoull(handles.c_str(), &end, 10)));
  calls.result = handle_of(static_cast<std::intptr_t>(std::wcstoull(end, nullptr, 10)));
  const std::string all = read_to_end(known);
  for (std::string_view rest = all; !rest.empty();) {
    ChildOutcome outcome;
    outcome.end = static_cast<ChildEnd>(rest[0]);
    rest.remove_prefix(1);
    for (std::string* text : {&outcome.how, &outcome.result, &outcome.messages}) *text = take_text(rest);
    calls.known.push_back(std::move(outcome));
  }
  ::_wputenv_s(kReplay, L"");
  return calls;
}

SECURITY_ATTRIBUTES inheritable() {
  SECURITY_ATTRIBUTES attributes = {};
  attributes.nLength = sizeof attributes;
  attributes.bInheritHandle = TRUE;
  return attributes;
}

/// A pipe whose writer a child inherits.
class Pipe {
 public:
  Pipe() {
    SECURITY_ATTRIBUTES attributes = inheritable();
    if (::CreatePipe(reader_.put(), writer_.put(), &attributes, 0) == 0) return;
    ::SetHandleInformation(reader_.get(), HANDLE_FLAG_INHERIT, 0);
  }
  bool is_open() const { return reader_.is_open(); }
  HANDLE reader() const { return reader_.get(); }
  HANDLE writer() const { return writer_.get(); }
  void close_writer() { writer_.close(); }

  /// Appends what can be read now, as far as it is no more than `most` in all.
  void drain(std::string& bytes, std::size_t most) const {
    std::array<char, 4096> buffer;
    for (DWORD there = 0; ::PeekNamedPipe(reader(), nullptr, 0, nullptr, &there, nullptr) != 0 && there > 0;) {
      DWORD count = 0;
      const DWORD wanted = std::min<DWORD>(there, buffer.size());
      if (::ReadFile(reader(), buffer.data(), wanted, &count, nullptr) == 0 || count == 0) return;
      bytes.append(buffer.data(), std::min<std::size_t>(count, most - bytes.size()));
    }
  }

 private:
  Handle reader_, writer_;
};

/// An inheritable file with these bytes that is gone when it is closed.
HANDLE file_with(std::string_view bytes) {
  std::error_code error;
  const std::string folder = text_of(fs::temp_directory_path(error));
  std::string name;
  const HANDLE file = make_temporary(folder, name, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE);
  if (file == INVALID_HANDLE_VALUE) return file;
  ::SetHandleInformation(file, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  if (write_handle(file, bytes) && ::SetFilePointer(file, 0, nullptr, FILE_BEGIN) == 0) return file;
  ::CloseHandle(file);
  return INVALID_HANDLE_VALUE;
}

HANDLE open_nothing() {
  SECURITY_ATTRIBUTES attributes = inheritable();
  return ::CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, &attributes,
                       OPEN_EXISTING, 0, nullptr);
}

/// A process that ends with this one, with these standard handles.
class Child {
 public:
  Child(std::wstring command_line, HANDLE input, HANDLE output, HANDLE errors)
      : job_(::CreateJobObjectW(nullptr, nullptr)) {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = {};
    limits.BasicLimitInformation.LimitFlags =
        JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    ::SetInformationJobObject(job_, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    STARTUPINFOW startup = {};
    startup.cb = sizeof startup;
    startup.dwFlags = STARTF_USESTDHANDLES;
    startup.hStdInput = input;
    startup.hStdOutput = output;
    startup.hStdError = errors;
    PROCESS_INFORMATION process = {};
    if (::CreateProcessW(nullptr, command_line.data(), nullptr, nullptr, TRUE, CREATE_SUSPENDED, nullptr, nullptr,
                         &startup, &process) == 0) {
      reason_ = last_reason();
      return;
    }
    process_ = process.hProcess;
    ::AssignProcessToJobObject(job_, process_);
    ::ResumeThread(process.hThread);
    ::CloseHandle(process.hThread);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    for (const HANDLE handle : {process_, job_}) {
      if (handle != nullptr) ::CloseHandle(handle);
    }
  }
  int reason() const { return reason_; }
  bool has_ended(DWORD milliseconds) const { return ::WaitForSingleObject(process_, milliseconds) == WAIT_OBJECT_0; }
  void kill() const { ::TerminateProcess(process_, EXIT_FAILURE); }
  DWORD exit_code() const {
    DWORD code = EXIT_FAILURE;
    ::GetExitCodeProcess(process_, &code);
    return code;
  }

 private:
  HANDLE job_ = nullptr, process_ = nullptr;
  int reason_ = 0;
};

/// For exit codes of processes that the system has ended.
std::string crash_name(DWORD code) {
  const char* const name = code == 0xC0000005   ? "access violation"
                           : code == 0xC00000FD ? "stack overflow"
                           : code == 0xC000001D ? "illegal instruction"
                           : code == 0xC0000094 ? "division by zero"
                           : code == 0xC0000409 ? "abort"
                                                : "exception";
  return fmt::format("{} (0x{:08x})", name, code);
}

constexpr DWORD kFirstCrash = 0xC0000000;

ChildOutcome wait_for(const Child& child, const Pipe& result, const Pipe& messages, std::chrono::milliseconds limit) {
  ChildOutcome outcome;
  const auto read = [&] {
    result.drain(outcome.result, kMostResult);
    messages.drain(outcome.messages, kMostMessages);
  };
  constexpr DWORD kMilliseconds = 5;
  const Clock::time_point end = Clock::now() + limit;
  bool has_ended = false;
  while (!(has_ended = child.has_ended(kMilliseconds)) && Clock::now() < end) read();
  if (!has_ended) {
    child.kill();
    outcome.end = ChildEnd::kTooLong;
    outcome.how = fmt::format("did not end within {:.3g} s", std::chrono::duration<double>(limit).count());
  }
  read();  // what it wrote last
  if (!has_ended) return outcome;
  const DWORD code = child.exit_code();
  if (code == EXIT_SUCCESS && !outcome.result.empty()) {
    outcome.end = ChildEnd::kDone;
  } else {
    outcome.how =
        code >= kFirstCrash ? "crashed: " + crash_name(code) : fmt::format("ended early, with exit status {}", code);
  }
  return outcome;
}

/// In the child that makes this call.
[[noreturn]] void run_and_exit(const std::function<std::string()>& work, HANDLE result) {
  ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
  try {
    write_handle(result, work());
    end_process(EXIT_SUCCESS);
  } catch (const std::exception& error) {
    write_all(kStandardError, fmt::format("{}\n", error.what()));
  }
  end_process(EXIT_FAILURE);
}

/// As CommandLineToArgvW() reads it.
std::wstring quoted_word(std::string_view word) {
  std::wstring out = L"\"";
  std::size_t slashes = 0;
  for (const wchar_t c : wide(word)) {
    if (c == L'"') out.append(slashes + 1, L'\\');
    slashes = c == L'\\' ? slashes + 1 : 0;
    out += c;
  }
  return out.append(slashes, L'\\') + L"\"";
}

// ---- The registry.

/// Calls visit(key) for the keys below a key of HKEY_LOCAL_MACHINE.
template <class Visit>
void visit_keys(const wchar_t* path, Visit visit) {
  HKEY parent = nullptr;
  if (::RegOpenKeyExW(HKEY_LOCAL_MACHINE, path, 0, KEY_READ, &parent) != ERROR_SUCCESS) return;
  std::array<wchar_t, 256> name;
  for (DWORD i = 0, length = 256;
       ::RegEnumKeyExW(parent, i, name.data(), &length, nullptr, nullptr, nullptr, nullptr) == ERROR_SUCCESS;
       ++i, length = 256) {
    HKEY key = nullptr;
    if (::RegOpenKeyExW(parent, name.data(), 0, KEY_READ, &key) != ERROR_SUCCESS) continue;
    visit(key);
    ::RegCloseKey(key);
  }
  ::RegCloseKey(parent);
}

std::string registry_text(HKEY key, const wchar_t* path, const wchar_t* name) {
  std::array<wchar_t, 1024> text = {};
  DWORD bytes = sizeof text - sizeof text[0];
  const LSTATUS status =
      ::RegGetValueW(key, path, name, RRF_RT_REG_SZ | RRF_RT_REG_MULTI_SZ, nullptr, text.data(), &bytes);
  return status == ERROR_SUCCESS ? utf8_of(text.data()) : std::string();
}

constexpr const wchar_t* kAdapters =
    L"SYSTEM\\CurrentControlSet\\Control\\Class\\{4d36e968-e325-11ce-bfc1-08002be10318}";

// ---- Signals.

std::atomic<void (*)()> stop_handler{nullptr};

BOOL WINAPI on_console_event(DWORD event) {
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) return FALSE;
  void (*const handler)() = stop_handler.exchange(nullptr);  // the second event ends the program
  if (handler == nullptr) return FALSE;
  handler();
  return TRUE;
}

HANDLE alarm_timer = nullptr;
std::string alarm_message;

void CALLBACK say_alarm(void*, BOOLEAN) { write_all(kStandardError, alarm_message); }

Handle limits_job(nullptr);

}  // namespace

std::FILE* open_to_read(const std::string& path) {
  std::FILE* const file = ::_wfopen(wide_path(path).c_str(), L"rb");
  if (file == nullptr && errno == EACCES) {
    const DWORD attributes = ::GetFileAttributesW(wide_path(path).c_str());
    const bool is_folder = attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    errno = is_folder ? EISDIR : EACCES;
  }
  return file;
}

std::uint64_t length_of_regular(std::FILE* file) {
  struct _stat64 status = {};
  if (::_fstat64(::_fileno(file), &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  return static_cast<std::uint64_t>(status.st_size);
}

bool write_all(int descriptor, std::string_view bytes) {
  const HANDLE stream = ::GetStdHandle(descriptor == kStandardOutput ? STD_OUTPUT_HANDLE : STD_ERROR_HANDLE);
  DWORD mode = 0;
  return ::GetConsoleMode(stream, &mode) != 0 ? write_console(stream, bytes) : write_handle(stream, bytes);
}

std::string file_key(const std::string& path) {
  const std::wstring given = wide(path);
  std::wstring key = given;
  const int length = static_cast<int>(given.size());
  ::LCMapStringEx(LOCALE_NAME_INVARIANT, LCMAP_UPPERCASE, given.data(), length, key.data(), length, nullptr, nullptr,
                  0);
  return utf8_of(key);
}

void remove_file(const std::string& path) { ::DeleteFileW(wide_path(path).c_str()); }

bool is_of_disk(int code) { return code == ENOSPC || code == EROFS || code == EIO; }

Fault check_target(const std::string& path) {
  if (is_device(path)) return {};
  const std::string target = follow_links(path);
  const DWORD attributes = ::GetFileAttributesW(wide_path(target).c_str());
  if (attributes != INVALID_FILE_ATTRIBUTES) {
    if ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) return {EISDIR};
    if ((attributes & FILE_ATTRIBUTE_READONLY) != 0) return {EACCES};
  }
  const std::string folder = folder_of(target), what = "folder " + folder + ": ";
  const DWORD above = ::GetFileAttributesW(wide_path(folder).c_str());
  if (above == INVALID_FILE_ATTRIBUTES) return {last_reason(), what};
  if ((above & FILE_ATTRIBUTE_DIRECTORY) == 0) return {ENOTDIR, what};
  const Handle opened(open_handle(wide_path(folder), FILE_ADD_FILE, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS));
  return opened.is_open() ? Fault() : Fault{last_reason(), what};
}

bool matches_pattern(const std::string& name, const std::string& pattern) {
  return name.starts_with('.') == pattern.starts_with('.') && matches(name, pattern);
}

int try_to_write(const std::string& folder) {
  std::string name;
  const Handle file(make_temporary(folder, name, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE));
  if (!file.is_open()) return last_reason();
  return write_handle(file.get(), "\n") && ::FlushFileBuffers(file.get()) != 0 ? 0 : last_reason();
}

// The file has a temporary name from the beginning, and is deleted with its handle until publish().
Fault NewFile::create(const std::string& path, bool may_be_unnamed) {
  target_ = follow_links(path);
  if (is_device(target_)) {
    handle_ = number_of(open_handle(wide_path(target_), GENERIC_WRITE, OPEN_EXISTING));
    return {handle_ == kNone ? last_reason() : 0};
  }
  const DWORD attributes = ::GetFileAttributesW(wide_path(target_).c_str());
  const bool exists = attributes != INVALID_FILE_ATTRIBUTES;
  if (exists && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) return {EISDIR};
  handle_ = number_of(make_temporary(folder_of(target_), temporary_, FILE_ATTRIBUTE_NORMAL));
  if (handle_ == kNone) {
    temporary_.clear();
    return {last_reason()};
  }
  unnamed_ = may_be_unnamed && set_deleted_at_end(handle_of(handle_), true);
  return {};
}

void NewFile::discard() {
  if (handle_ != kNone) ::CloseHandle(handle_of(std::exchange(handle_, kNone)));
  if (!temporary_.empty()) ::DeleteFileW(wide_path(std::exchange(temporary_, {})).c_str());
}

Fault NewFile::write(std::string_view bytes) {
  if (write_handle(handle_of(handle_), bytes)) return {};
  return {errno};
}

Fault NewFile::finish() {
  const bool is_flushed = ::FlushFileBuffers(handle_of(handle_)) != 0;
  const bool is_device_of_bytes = ::GetFileType(handle_of(handle_)) != FILE_TYPE_DISK;
  return {is_flushed || is_device_of_bytes ? 0 : last_reason()};
}

Fault NewFile::name_it() {
  if (!set_deleted_at_end(handle_of(handle_), false)) return {last_reason()};
  unnamed_ = false;
  return {};
}

Fault NewFile::publish() {
  if (unnamed_) {
    if (Fault fault = name_it(); fault.code != 0) return fault;
  }
  if (::CloseHandle(handle_of(std::exchange(handle_, kNone))) == 0) return {last_reason()};
  if (temporary_.empty()) return {};
  const std::wstring from = wide_path(temporary_), to = wide_path(target_);
  if (::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) == 0) {
    return {last_reason()};
  }
  temporary_.clear();
  return {};
}

int LockedFile::lock(const std::string& path) {
  const HANDLE file = open_handle(wide_path(path), GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS);
  if (file == INVALID_HANDLE_VALUE) return last_reason();
  handle_ = number_of(file);
  OVERLAPPED at = {};
  if (::LockFileEx(file, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &at) != 0) return 0;
  const DWORD code = ::GetLastError();
  if (code == ERROR_LOCK_VIOLATION || code == ERROR_IO_PENDING) return EWOULDBLOCK;
  return code == ERROR_NOT_SUPPORTED || code == ERROR_INVALID_FUNCTION ? 0 : last_reason();
}

LockedFile::~LockedFile() {
  if (handle_ != kNone) ::CloseHandle(handle_of(handle_));
}

int AppendedFile::open(const std::string& path) {
  close();
  handle_ = number_of(open_handle(wide_path(path), FILE_APPEND_DATA | SYNCHRONIZE, OPEN_EXISTING));
  return handle_ == kNone ? last_reason() : 0;
}

int AppendedFile::append(std::string_view bytes) { return write_handle(handle_of(handle_), bytes) ? 0 : errno; }

void AppendedFile::close() {
  if (handle_ != kNone) ::CloseHandle(handle_of(std::exchange(handle_, kNone)));
}

std::vector<std::string> prepare_process(int, char**) {
  for (const int descriptor : {0, 1, 2}) ::_setmode(descriptor, _O_BINARY);
  int count = 0;
  const std::unique_ptr<wchar_t*, decltype(&::LocalFree)> words(::CommandLineToArgvW(::GetCommandLineW(), &count),
                                                                &::LocalFree);
  std::vector<std::string> arguments;
  for (int i = 1; words && i < count; ++i) arguments.push_back(utf8_of(words.get()[i]));
  return arguments;
}

void end_process(int code) {
  ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(code));
  std::abort();  // is not reached
}

std::string folder_of_program() {
  std::wstring name(32768, L'\0');
  name.resize(::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
  return text_of(fs::path(name).parent_path());
}

bool is_program(const std::string& path) {
  const DWORD attributes = ::GetFileAttributesW(wide_path(path + ".exe").c_str());
  return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
}

std::optional<std::string> variable_of(const std::string& name) {
  const wchar_t* const value = ::_wgetenv(wide(name).c_str());
  return value != nullptr ? std::optional<std::string>(utf8_of(value)) : std::nullopt;
}

void set_variable(const std::string& name, const std::string& value, bool replace) {
  if (replace || variable(wide(name).c_str()).empty()) ::_wputenv_s(wide(name).c_str(), wide(value).c_str());
}

void unset_variable(const std::string& name) { ::_wputenv_s(wide(name).c_str(), L""); }

ChildOutcome run_in_child(const std::function<std::string()>& work, std::chrono::milliseconds limit,
                          std::string& problem) {
  static Calls calls = begin_calls();
  if (calls.made < calls.known.size()) return calls.known[calls.made++];
  if (calls.result != INVALID_HANDLE_VALUE) run_and_exit(work, calls.result);
  std::string known;
  for (const ChildOutcome& outcome : calls.known) known += encode_outcome(outcome);
  const Handle known_file(file_with(known)), nothing(open_nothing());
  Pipe result, messages;
  if (!known_file.is_open() || !result.is_open() || !messages.is_open()) {
    problem = fmt::format("no pipe to another process: {}", std::strerror(last_reason()));
    return {};
  }
  const std::string handles = fmt::format("{} {}", number_of(known_file.get()), number_of(result.writer()));
  ::_wputenv_s(kReplay, wide(handles).c_str());
  const Child child(::GetCommandLineW(), nothing.get(), messages.writer(), messages.writer());
  ::_wputenv_s(kReplay, L"");
  if (child.reason() != 0) {
    problem = fmt::format("no other process: {}", std::strerror(child.reason()));
    return {};
  }
  result.close_writer();
  messages.close_writer();
  calls.known.push_back(wait_for(child, result, messages, limit));
  ++calls.made;
  return calls.known.back();
}

ProgramOutcome run_program(const std::string& program, const std::vector<std::string>& arguments, std::string input) {
  const Handle file(file_with(input)), nothing(open_nothing());
  Pipe output;
  if (!file.is_open() || !output.is_open()) return {.code = last_reason(), .has_input = false};
  input = std::string();
  std::wstring command_line = quoted_word(program + ".exe");
  for (const std::string& argument : arguments) command_line += L" " + quoted_word(argument);
  const Child child(command_line, file.get(), output.writer(), nothing.get());
  if (child.reason() != 0) return {.code = child.reason()};
  output.close_writer();
  ProgramOutcome outcome;
  outcome.output = read_to_end(output.reader());
  while (!child.has_ended(INFINITE)) continue;
  const DWORD code = child.exit_code();
  if (code == ERROR_NOT_ENOUGH_QUOTA || code == STATUS_NO_MEMORY) {
    outcome.reason = "it took too much time or memory";
  } else if (code >= kFirstCrash) {
    outcome.reason = fmt::format("it crashed ({})", crash_name(code));
  } else if (code != 0) {
    outcome.reason = fmt::format("it ended with exit code {}", code);
  }
  return outcome;
}

std::string_view standard_input_bytes() {
  static const std::string bytes = read_to_end(::GetStdHandle(STD_INPUT_HANDLE));
  return bytes;
}

// Its parent has put it into a job with which it ends. Windows has no limit of the files that a process may write.
void limit_this_process() { ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX); }

void limit_use(std::uint64_t memory, std::uint64_t seconds) {
  if (!limits_job.is_open()) {
    *limits_job.put() = ::CreateJobObjectW(nullptr, nullptr);
    ::AssignProcessToJobObject(limits_job.get(), ::GetCurrentProcess());
  }
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = {};
  limits.BasicLimitInformation.LimitFlags =
      JOB_OBJECT_LIMIT_PROCESS_TIME | (memory > 0 ? JOB_OBJECT_LIMIT_PROCESS_MEMORY : 0u);
  limits.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = static_cast<LONGLONG>(seconds * 10'000'000);
  limits.ProcessMemoryLimit = static_cast<SIZE_T>(memory);
  ::SetInformationJobObject(limits_job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
}

void on_request_to_stop(void (*handler)()) {
  stop_handler = handler;
  ::SetConsoleCtrlHandler(on_console_event, TRUE);
}

int run_apart_from_signals(const std::function<int()>& work) {
  int code = EXIT_FAILURE;
  std::thread([&] { code = work(); }).join();
  return code;
}

void set_alarm(unsigned seconds, const std::string& message) {
  alarm_message = message;
  ::CreateTimerQueueTimer(&alarm_timer, nullptr, say_alarm, nullptr, seconds * 1000, 0, WT_EXECUTEONLYONCE);
}

void cancel_alarm() {
  if (alarm_timer != nullptr) ::DeleteTimerQueueTimer(nullptr, std::exchange(alarm_timer, nullptr), nullptr);
}

bool has_terminal() {
  const HANDLE errors = ::GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  return ::GetConsoleMode(errors, &mode) != 0 &&
         ::SetConsoleMode(errors, mode | ENABLE_PROCESSED_OUTPUT | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

void* load_library(const std::string& name, std::string& problem) {
  const HMODULE library = ::LoadLibraryW(path_of(name).make_preferred().wstring().c_str());
  problem = library == nullptr ? std::system_category().message(static_cast<int>(::GetLastError())) : std::string();
  return reinterpret_cast<void*>(library);
}

void* load_vulkan(std::string& problem) { return load_library("vulkan-1.dll", problem); }

void* function_of(void* library, const char* name) {
  return reinterpret_cast<void*>(::GetProcAddress(reinterpret_cast<HMODULE>(library), name));
}

std::string file_of(void* library) {
  std::wstring name(32768, L'\0');
  const DWORD length =
      ::GetModuleFileNameW(reinterpret_cast<HMODULE>(library), name.data(), static_cast<DWORD>(name.size()));
  return text_of(fs::path(name.substr(0, length)));
}

std::string system_name() {
  const std::string name =
      registry_text(HKEY_LOCAL_MACHINE, L"SOFTWARE\\Microsoft\\Windows NT\\CurrentVersion", L"ProductName");
  return name.empty() ? "Windows" : name;
}

std::string kernel_name() {
  const HMODULE kernel = ::GetModuleHandleW(L"ntdll.dll");
  RTL_OSVERSIONINFOW version = {};
  version.dwOSVersionInfoSize = sizeof version;
  using GetVersion = LONG(WINAPI*)(RTL_OSVERSIONINFOW*);
  const auto get = reinterpret_cast<GetVersion>(function_of(kernel, "RtlGetVersion"));
  if (get == nullptr || get(&version) != 0) return "unknown kernel";
  std::string name =
      fmt::format("Windows NT {}.{}.{}, x86_64", version.dwMajorVersion, version.dwMinorVersion, version.dwBuildNumber);
  using GetWine = const char*(CDECL*)();
  if (const auto wine = reinterpret_cast<GetWine>(function_of(kernel, "wine_get_version"))) {
    name += fmt::format(", by Wine {}", wine());
  }
  return name;
}

void return_large_blocks() {}

// As the loader does: with a high level of integrity, that of administrators, it ignores variables.
bool has_more_rights() {
  Handle token;
  if (::OpenProcessToken(::GetCurrentProcess(), TOKEN_QUERY, token.put()) == 0) return false;
  std::array<std::byte, 256> label = {};
  DWORD length = 0;
  if (::GetTokenInformation(token.get(), TokenIntegrityLevel, label.data(), label.size(), &length) == 0) return false;
  const PSID sid = reinterpret_cast<TOKEN_MANDATORY_LABEL*>(label.data())->Label.Sid;
  const DWORD last = *::GetSidSubAuthorityCount(sid) - 1u;
  return *::GetSidSubAuthority(sid, last) >= SECURITY_MANDATORY_HIGH_RID;
}

std::string group_of(const std::string&) { return {}; }
std::string why_not_open(const std::string&) { return {}; }

std::vector<std::string> registered_drivers() {
  std::vector<std::string> files;
  visit_keys(kAdapters, [&](HKEY key) {
    if (std::string file = registry_text(key, nullptr, L"VulkanDriverName"); !file.empty()) {
      files.push_back(text_of(path_of(file)));
    }
  });
  HKEY key = nullptr;
  if (::RegOpenKeyExW(HKEY_LOCAL_MACHINE, L"SOFTWARE\\Khronos\\Vulkan\\Drivers", 0, KEY_READ, &key) != ERROR_SUCCESS) {
    return files;
  }
  std::wstring name(16384, L'\0');
  for (DWORD i = 0;; ++i) {
    DWORD length = static_cast<DWORD>(name.size()), type = 0, value = 1, bytes = sizeof value;
    const LSTATUS status =
        ::RegEnumValueW(key, i, name.data(), &length, nullptr, &type, reinterpret_cast<BYTE*>(&value), &bytes);
    if (status != ERROR_SUCCESS) break;
    if (type == REG_DWORD && value == 0) files.push_back(text_of(fs::path(name.substr(0, length))));
  }
  ::RegCloseKey(key);
  return files;
}

std::vector<std::string> registered_adapters() {
  std::vector<std::string> names;
  visit_keys(kAdapters, [&](HKEY key) {
    if (std::string name = registry_text(key, nullptr, L"DriverDesc"); !name.empty()) names.push_back(std::move(name));
  });
  return names;
}

}  // namespace medial_vk::platform
