/* Stands for git in tests with a Windows Python: asks `support/windows.py` at URDFSYNC_GIT_PORT to run the system's git. */
#include <winsock2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static SOCKET server;

static void put(const void *data, unsigned size) {
  send(server, (const char *)&size, 4, 0);
  for (const char *place = data; size;) {
    int sent = send(server, place, size, 0);
    if (sent <= 0) exit(127);
    place += sent, size -= sent;
  }
}

static void put_wide(const wchar_t *text) {
  int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, 0, 0, 0, 0);
  char *bytes = malloc(size);
  WideCharToMultiByte(CP_UTF8, 0, text, -1, bytes, size, 0, 0);
  put(bytes, size - 1);
}

static unsigned get(char **data) {
  unsigned size, done = 0;
  if (recv(server, (char *)&size, 4, MSG_WAITALL) != 4) exit(127);
  *data = malloc(size + 1);
  while (done < size) {
    int count = recv(server, *data + done, size - done, 0);
    if (count <= 0) exit(127);
    done += count;
  }
  return size;
}

static void pass_on(DWORD stream) {
  char *data;
  unsigned size = get(&data);
  DWORD written;
  while (size && WriteFile(GetStdHandle(stream), data, size, &written, 0)) data += written, size -= written;
}

int wmain(int count, wchar_t **arguments) {
  WSADATA started;
  WSAStartup(0x202, &started);
  server = socket(AF_INET, SOCK_STREAM, 0);
  struct sockaddr_in place = {AF_INET, htons(atoi(getenv("URDFSYNC_GIT_PORT"))), {{{127, 0, 0, 1}}}};
  if (connect(server, (struct sockaddr *)&place, sizeof place)) return 127;
  wchar_t folder[4096];
  GetCurrentDirectoryW(4096, folder);
  put_wide(folder);
  for (int number = 1; number < count; number++) put_wide(arguments[number]);
  put("", 0);
  for (wchar_t *variable = GetEnvironmentStringsW(); *variable; variable += wcslen(variable) + 1)
    if (!wcsncmp(variable, L"GIT_", 4) || !wcsncmp(variable, L"LC_ALL=", 7)) put_wide(variable);
  put("", 0);
  static char input[1 << 20];
  DWORD size;
  HANDLE stdin_ = GetStdHandle(STD_INPUT_HANDLE);
  if (GetFileType(stdin_) != FILE_TYPE_CHAR)
    while (ReadFile(stdin_, input, sizeof input, &size, 0) && size) put(input, size);
  put("", 0);
  char *code;
  get(&code);
  int status = atoi(code);
  pass_on(STD_OUTPUT_HANDLE);
  pass_on(STD_ERROR_HANDLE);
  return status;
}
