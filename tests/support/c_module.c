/* A Lua module in C, as users write them: functions, userdata, errors, calls back into Lua, yields.
 * It declares what it uses of Lua 5.4 itself, so that the test needs a compiler and no headers. */

#include <stddef.h>

typedef struct lua_State lua_State;
typedef long long lua_Integer;
typedef ptrdiff_t lua_KContext;
typedef int (*lua_CFunction)(lua_State *L);
typedef int (*lua_KFunction)(lua_State *L, int status, lua_KContext context);
typedef struct { const char *name; lua_CFunction function; } luaL_Reg;

extern int lua_gettop(lua_State *L);
extern void lua_settop(lua_State *L, int index);
extern void lua_rotate(lua_State *L, int index, int n);
extern void lua_pushinteger(lua_State *L, lua_Integer n);
extern const char *lua_pushfstring(lua_State *L, const char *format, ...);
extern void lua_pushvalue(lua_State *L, int index);
extern void lua_pushboolean(lua_State *L, int b);
extern void lua_setfield(lua_State *L, int index, const char *key);
extern int lua_getfield(lua_State *L, int index, const char *key);
extern void lua_createtable(lua_State *L, int array, int fields);
extern int lua_setmetatable(lua_State *L, int index);
extern void *lua_newuserdatauv(lua_State *L, size_t size, int values);
extern void lua_callk(lua_State *L, int arguments, int results, lua_KContext context, lua_KFunction k);
extern int lua_pcallk(lua_State *L, int arguments, int results, int handler, lua_KContext context, lua_KFunction k);
extern int lua_yieldk(lua_State *L, int results, lua_KContext context, lua_KFunction k);
extern lua_Integer luaL_checkinteger(lua_State *L, int argument);
extern const char *luaL_checklstring(lua_State *L, int argument, size_t *length);
extern void *luaL_checkudata(lua_State *L, int argument, const char *type);
extern int luaL_newmetatable(lua_State *L, const char *type);
extern void luaL_setmetatable(lua_State *L, const char *type);
extern void luaL_setfuncs(lua_State *L, const luaL_Reg *list, int upvalues);
extern int luaL_error(lua_State *L, const char *format, ...);
extern void luaL_checkversion_(lua_State *L, double version, size_t sizes);

enum { MULTIPLE_RESULTS = -1, LUA_5_4 = 504, NUMBER_SIZES = sizeof(lua_Integer) * 16 + sizeof(double) };

static const char COUNTER[] = "c_module.counter";
static int living = 0;

static int add(lua_State *L) {
    lua_pushinteger(L, luaL_checkinteger(L, 1) + luaL_checkinteger(L, 2));
    return 1;
}

static int new_counter(lua_State *L) {
    lua_Integer start = luaL_checkinteger(L, 1);
    lua_Integer *count = lua_newuserdatauv(L, sizeof *count, 0);
    *count = start;
    luaL_setmetatable(L, COUNTER);
    living++;
    return 1;
}

static int increment(lua_State *L) {
    lua_Integer *count = luaL_checkudata(L, 1, COUNTER);
    lua_pushinteger(L, ++*count);
    return 1;
}

static int to_string(lua_State *L) {
    lua_Integer *count = luaL_checkudata(L, 1, COUNTER);
    lua_pushfstring(L, "counter at %I", *count);
    return 1;
}

static int collect(lua_State *L) {
    luaL_checkudata(L, 1, COUNTER);
    living--;
    return 0;
}

static int how_many(lua_State *L) {
    lua_pushinteger(L, living);
    return 1;
}

static int fail(lua_State *L) { return luaL_error(L, "C says: %s", luaL_checklstring(L, 1, NULL)); }

/* apply(f, ...): the results of f(...). Errors and yields go through. */
static int after_apply(lua_State *L, int status, lua_KContext context) {
    (void)status, (void)context;
    return lua_gettop(L);
}

static int apply(lua_State *L) {
    lua_callk(L, lua_gettop(L) - 1, MULTIPLE_RESULTS, 0, after_apply);
    return after_apply(L, 0, 0);
}

/* protect(f, ...): true and the results of f(...), or false and the error. Yields go through. */
static int after_protect(lua_State *L, int status, lua_KContext context) {
    (void)context;
    lua_pushboolean(L, status == 0 || status == 1);
    lua_rotate(L, 1, 1);
    return lua_gettop(L);
}

static int protect(lua_State *L) {
    int status = lua_pcallk(L, lua_gettop(L) - 1, MULTIPLE_RESULTS, 0, 0, after_protect);
    return after_protect(L, status, 0);
}

/* yield(...): the values the coroutine is resumed with. */
static int yield(lua_State *L) { return lua_yieldk(L, lua_gettop(L), 0, after_apply); }

int luaopen_c_module(lua_State *L) {
    static const luaL_Reg methods[] = {{"increment", increment}, {"__tostring", to_string}, {"__gc", collect}, {NULL, NULL}};
    static const luaL_Reg functions[] = {{"add", add}, {"counter", new_counter}, {"living", how_many}, {"fail", fail},
        {"apply", apply}, {"protect", protect}, {"yield", yield}, {NULL, NULL}};
    luaL_checkversion_(L, LUA_5_4, NUMBER_SIZES);
    luaL_newmetatable(L, COUNTER);
    luaL_setfuncs(L, methods, 0);
    lua_pushvalue(L, -1);
    lua_setfield(L, -2, "__index");
    lua_settop(L, 0);
    lua_createtable(L, 0, 7);
    luaL_setfuncs(L, functions, 0);
    return 1;
}

int luaopen_c_module_inner(lua_State *L) {
    lua_pushinteger(L, 7);
    return 1;
}
