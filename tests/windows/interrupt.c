/* interrupt MILLISECONDS COMMAND...: runs a command in a console of its own, sends Ctrl-C to it after so many
   milliseconds, and ends with its exit code, or with 4 if the code page of the console, which the programs of a user
   share, is another one then. For scripts/test-windows, by MinGW-w64. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>
#include <windows.h>

int wmain(int count, wchar_t** words) {
  if (count < 3) return 2;
  /* The command as it stands behind the first two words, with its quotation marks. */
  wchar_t* rest = GetCommandLineW();
  for (int word = 0; word < 2; ++word) {
    int quoted = 0;
    for (; *rest && (quoted || *rest != L' '); ++rest) quoted ^= *rest == L'"';
    while (*rest == L' ') ++rest;
  }
  HANDLE streams[3] = {GetStdHandle(STD_INPUT_HANDLE), GetStdHandle(STD_OUTPUT_HANDLE), GetStdHandle(STD_ERROR_HANDLE)};
  FreeConsole();
  if (!AllocConsole()) {
    fprintf(stderr, "interrupt: no console\n");
    return 3;
  }
  SetConsoleOutputCP(437);
  const UINT page = GetConsoleOutputCP();
  STARTUPINFOW startup;
  PROCESS_INFORMATION process;
  memset(&startup, 0, sizeof startup);
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = streams[0];
  startup.hStdOutput = streams[1];
  startup.hStdError = streams[2];
  for (int i = 0; i < 3; ++i) SetHandleInformation(streams[i], HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  if (!CreateProcessW(NULL, rest, NULL, NULL, TRUE, 0, NULL, NULL, &startup, &process)) {
    fprintf(stderr, "interrupt: the command does not start: %lu\n", GetLastError());
    return 3;
  }
  if (WaitForSingleObject(process.hProcess, (DWORD)_wtoi(words[1])) == WAIT_TIMEOUT) {
    SetConsoleCtrlHandler(NULL, TRUE); /* not for this program */
    GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0);
  } else {
    fprintf(stderr, "interrupt: the command has ended before\n");
  }
  WaitForSingleObject(process.hProcess, 120000);
  DWORD code = 1;
  GetExitCodeProcess(process.hProcess, &code);
  if (GetConsoleOutputCP() != page) {
    fprintf(stderr, "interrupt: the code page was %u and is %u\n", page, GetConsoleOutputCP());
    return 4;
  }
  return (int)code;
}
