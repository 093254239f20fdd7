// Stands before libc's functions that reach other machines: whoever asks for one ends with its name.
#include <stdio.h>
#include <stdlib.h>

#define FORBIDDEN(name)                                \
  int name() {                                         \
    fprintf(stderr, "asked the network: %s\n", #name); \
    _Exit(99);                                         \
  }

FORBIDDEN(socket)
FORBIDDEN(connect)
FORBIDDEN(getaddrinfo)
FORBIDDEN(gethostbyname)
FORBIDDEN(res_query)
