/* Comes before each file of Lua: files are opened and closed by functions of ours. Macros on the command line would not do, since headers
   give some of these functions other symbols. */
#include "lprefix.h"
#include <stdio.h>

FILE *swanilda_fopen(const char *name, const char *mode);
FILE *swanilda_popen(const char *command, const char *mode);
FILE *swanilda_tmpfile(void);
int swanilda_fclose(FILE *file);
int swanilda_pclose(FILE *file);

#define fopen swanilda_fopen
#define popen swanilda_popen
#define tmpfile swanilda_tmpfile
#define fclose swanilda_fclose
#define pclose swanilda_pclose
