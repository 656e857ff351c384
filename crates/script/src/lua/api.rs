//! Functions of Lua's that cannot fail: the types of their arguments are the proof.
//!
//! A [`Stack`] is a living coroutine and a [`Slot`] an index Lua can look at. The other types say what is on the stack at the moment:
//! they are made and used in one expression, and only in `script/lua`.

mod new_table;

use std::ffi::{c_char, c_int, c_void};
use std::mem::MaybeUninit;

use mlua::ffi;

use super::stack::tables::MAX_HINT;
use super::stack::{Stack, Type};
pub(crate) use new_table::Scalar;

/// Longer strings are cut: Lua would raise where it cannot have the memory.
const MAX_STRING_LENGTH: usize = 1 << 29;

/// An index that every function accepts; nothing may be there, which Lua reads as no value.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub(super) struct Slot(c_int);

/// The index of a table.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Table(c_int);

/// The indices from a value up to the top.
#[repr(transparent)]
pub(super) struct Occupied(c_int);

/// A function that Lua calls as a hook.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Hook(ffi::lua_Hook);

/// A stack with a free place.
#[repr(transparent)]
pub(crate) struct Room<'a>(Stack<'a>);

/// A stack with a value on top, which is popped.
#[repr(transparent)]
pub(super) struct Top<'a>(Stack<'a>);

/// A stack with a key for a table and a value on top, which are popped.
#[repr(transparent)]
pub(super) struct Pair<'a>(Stack<'a>);

/// A stack with a key of a table on top, or nil, and a free place.
#[repr(transparent)]
struct Known<'a>(Stack<'a>);

// SAFETY: declared as in lua.h, since the types are pointers to a `lua_State` and ints. With a living state the first ones read or convert,
// and a positive index beyond the top is "no value" to them; the second ones push one value, for which there is room. The others
// get the table, key and values that they need. Raw access runs no code. Out of memory ends the process where Rust allocates
// (`budget.rs`), so nothing here raises.
unsafe extern "C-unwind" {
    pub(super) safe fn lua_gettop(stack: Stack<'_>) -> c_int;
    pub(super) safe fn lua_checkstack(stack: Stack<'_>, count: c_int) -> c_int;
    pub(super) safe fn lua_status(stack: Stack<'_>) -> c_int;
    pub(super) safe fn lua_gethook(stack: Stack<'_>) -> Option<Hook>;
    pub(super) safe fn lua_gethookmask(stack: Stack<'_>) -> c_int;
    pub(super) safe fn lua_gethookcount(stack: Stack<'_>) -> c_int;
    pub(super) safe fn lua_sethook(
        stack: Stack<'_>,
        hook: Option<Hook>,
        mask: c_int,
        interval: c_int,
    );
    safe fn lua_getstack(
        stack: Stack<'_>,
        level: c_int,
        record: &mut MaybeUninit<ffi::lua_Debug>,
    ) -> c_int;
    pub(super) safe fn lua_isyieldable(stack: Stack<'_>) -> c_int;
    pub(super) safe fn lua_type(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_iscfunction(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_isinteger(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_tonumberx(
        stack: Stack<'_>,
        slot: Slot,
        is_number: Option<&mut c_int>,
    ) -> f64;
    pub(super) safe fn lua_tointegerx(
        stack: Stack<'_>,
        slot: Slot,
        is_integer: Option<&mut c_int>,
    ) -> i64;
    pub(super) safe fn lua_toboolean(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_tolstring(
        stack: Stack<'_>,
        slot: Slot,
        length: Option<&mut usize>,
    ) -> *const c_char;
    pub(super) safe fn lua_tocfunction(stack: Stack<'_>, slot: Slot) -> Option<ffi::lua_CFunction>;
    pub(super) safe fn lua_topointer(stack: Stack<'_>, slot: Slot) -> *const c_void;
    pub(super) safe fn lua_rawlen(stack: Stack<'_>, slot: Slot) -> u64;
    pub(super) safe fn lua_rawequal(stack: Stack<'_>, a: Slot, b: Slot) -> c_int;

    pub(super) safe fn lua_pushnil(room: Room<'_>);
    pub(super) safe fn lua_pushboolean(room: Room<'_>, value: c_int);
    pub(super) safe fn lua_pushinteger(room: Room<'_>, value: i64);
    pub(super) safe fn lua_pushnumber(room: Room<'_>, value: f64);
    pub(super) safe fn lua_pushvalue(room: Room<'_>, slot: Slot);
    pub(super) safe fn lua_pushthread(room: Room<'_>) -> c_int;
    pub(super) safe fn luaL_where(room: Room<'_>, level: c_int);
    pub(super) safe fn luaL_traceback(
        room: Room<'_>,
        of: Stack<'_>,
        message: Option<&c_char>,
        level: c_int,
    );
    pub(super) safe fn lua_createtable(room: Room<'_>, array: c_int, fields: c_int);
    pub(super) safe fn lua_getmetatable(room: Room<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_getupvalue(room: Room<'_>, slot: Slot, number: c_int) -> *const c_char;
    pub(super) safe fn lua_rawgeti(room: Room<'_>, table: Table, i: i64) -> c_int;
    pub(super) safe fn lua_rawgetp(room: Room<'_>, table: Table, key: *const c_void) -> c_int;

    safe fn lua_settop(stack: Stack<'_>, top: Occupied);
    safe fn lua_rotate(stack: Stack<'_>, slots: Occupied, by: c_int);
    pub(super) safe fn lua_rawget(key: Top<'_>, table: Table) -> c_int;
    pub(super) safe fn lua_rawset(pair: Pair<'_>, table: Table);
    pub(super) safe fn lua_rawseti(value: Top<'_>, table: Table, i: i64);
    pub(super) safe fn lua_rawsetp(value: Top<'_>, table: Table, key: *const c_void);
    pub(super) safe fn luaL_ref(value: Top<'_>, table: Table) -> c_int;
    pub(super) safe fn luaL_unref(stack: Stack<'_>, table: Table, reference: c_int);
    safe fn lua_setmetatable(table: Top<'_>, owner: Slot) -> c_int;
    safe fn lua_next(key: Known<'_>, table: Table) -> c_int;
}

impl Slot {
    /// The number of a running function of ours.
    pub(super) const NUMBER: Self = Self(ffi::lua_upvalueindex(1));
    /// The first argument of a running function.
    pub(super) const FIRST: Self = Self(1);

    pub(super) fn index(self) -> c_int {
        self.0
    }
}

impl Hook {
    /// Of coroutines: pre-empts and stops them.
    pub(super) const COUNT: Self = Self(super::hooks::count::hook);
    /// Beside a hook of a script that counts nothing.
    pub(super) const BESIDE: Self = Self(super::hooks::beside::beside_hook);
    /// Beside a hook of a script that counts instructions.
    pub(super) const BESIDE_COUNTING: Self = Self(super::hooks::beside::beside_counting_hook);

    pub(super) fn function(self) -> ffi::lua_Hook {
        self.0
    }
}

impl PartialEq for Hook {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::fn_addr_eq(self.0, other.0)
    }
}

impl Table {
    pub(super) const REGISTRY: Self = Self(ffi::LUA_REGISTRYINDEX);
}

impl<'a> Stack<'a> {
    /// Whether no function of this coroutine runs.
    pub(crate) fn is_outermost(self) -> bool {
        lua_getstack(self, 0, &mut MaybeUninit::uninit()) == 0
    }

    /// The slot with Lua's index `index`; no value for one below the bottom.
    pub(super) fn slot(self, index: c_int) -> Slot {
        if index > 0 {
            return Slot(index);
        }
        let top = lua_gettop(self);
        Slot(if (-top..0).contains(&index) {
            top + index + 1
        } else {
            top + 1
        })
    }

    /// The table at `index`.
    pub fn table(self, index: c_int) -> Table {
        let slot = self.slot(index);
        assert_eq!(
            Type::from_raw(lua_type(self, slot)),
            Type::Table,
            "raw access is for tables"
        );
        Table(slot.0)
    }

    /// The table at `index`, and the value on top: there is one where a table is.
    pub(super) fn table_and_value(self, index: c_int) -> (Table, Top<'a>) {
        (self.table(index), Top(self))
    }

    /// Room for one more value. Lua's stack is limited to a million.
    pub(crate) fn room(self) -> Room<'a> {
        self.room_for(1)
    }

    /// The same, and for what Lua pushes meanwhile.
    pub(super) fn large_room(self) -> Room<'a> {
        self.room_for(ffi::LUA_MINSTACK)
    }

    fn room_for(self, count: c_int) -> Room<'a> {
        assert!(lua_checkstack(self, count) != 0, "stack overflow");
        Room(self)
    }

    /// The value on top.
    pub(super) fn value(self) -> Top<'a> {
        assert!(lua_gettop(self) > 0, "only what is there can be popped");
        Top(self)
    }

    /// The key and value on top; None for a key that no table can have.
    pub(super) fn pair(self) -> Option<Pair<'a>> {
        let top = lua_gettop(self);
        assert!(top > 1, "only what is there can be popped");
        let key = Slot(top - 1);
        // Only of numbers: asking a string for its number would parse it.
        let is_key = match lua_type(self, key) {
            ffi::LUA_TNIL => false,
            ffi::LUA_TNUMBER => !lua_tonumberx(self, key, None).is_nan(),
            _ => true,
        };
        is_key.then_some(Pair(self))
    }

    /// Reads elements of the list at `index`, from number `first` on; false when one of them is no number.
    pub(crate) fn numbers_into(self, index: c_int, first: i64, out: &mut [f64]) -> bool {
        let (table, top) = (self.table(index), lua_gettop(self));
        let _room = self.room();
        let mut is_number = 1;
        for (i, number) in (first..).zip(out) {
            // There is room: each value is popped before the next is pushed.
            lua_rawgeti(Room(self), table, i);
            *number = lua_tonumberx(self, Slot(top + 1), Some(&mut is_number));
            lua_settop(self, Occupied(top));
            if is_number == 0 {
                return false;
            }
        }
        true
    }

    /// The items of the table at `index`, converted, when its keys are 1, 2, 3 and so on, and all its values are numbers. Nothing runs
    /// meanwhile that could change it.
    #[expect(clippy::cast_possible_truncation, reason = "a table is in memory")]
    pub(crate) fn list_of_numbers<T>(
        self,
        index: c_int,
        convert: impl Fn(Scalar) -> T,
    ) -> Option<Vec<T>> {
        let table = self.table(index);
        let len = lua_rawlen(self, Slot(table.0)) as usize;
        if len == 0 {
            return None;
        }
        lua_pushnil(self.room_for(3));
        let key = lua_gettop(self);
        let mut items = Vec::with_capacity(len.min(MAX_HINT));
        while lua_next(Known(self), table) != 0 {
            let is_next = self.integer(key) == Some(numbers::count(items.len()) + 1);
            let Some(item) = self.number_in(Slot(key + 1)).filter(|_| is_next) else {
                lua_settop(self, Occupied(key - 1));
                return None;
            };
            items.push(convert(item));
            lua_settop(self, Occupied(key));
        }
        (items.len() == len).then_some(items)
    }

    /// Pushes `table[key]`, where the table and the key are in slots.
    pub(crate) fn push_entry(self, table: c_int, key: c_int) -> Type {
        let (table, key) = (self.table(table), self.slot(key));
        assert!(
            lua_type(self, key) != ffi::LUA_TNONE,
            "only what is there can be copied"
        );
        lua_pushvalue(self.room(), key);
        Type::from_raw(lua_rawget(Top(self), table))
    }

    /// Pushes the table in a slot, with new values of fields, whose names are in slots too.
    pub(crate) fn push_with_fields(self, table: c_int, fields: impl Iterator<Item = (c_int, i64)>) {
        let table = self.table(table);
        lua_pushvalue(self.room_for(3), Slot(table.0));
        for (name, value) in fields {
            let name = self.slot(name);
            assert_eq!(lua_type(self, name), ffi::LUA_TSTRING, "fields have names");
            // There is room: key and value are popped before the next ones are pushed.
            lua_pushvalue(Room(self), name);
            lua_pushinteger(Room(self), value);
            lua_rawset(Pair(self), Table(table.0));
        }
    }

    /// The number in a slot; a string is none.
    fn number_in(self, slot: Slot) -> Option<Scalar> {
        if lua_type(self, slot) != ffi::LUA_TNUMBER {
            return None;
        }
        Some(match lua_isinteger(self, slot) {
            0 => Scalar::Number(lua_tonumberx(self, slot, None)),
            _ => Scalar::Int(lua_tointegerx(self, slot, None)),
        })
    }

    /// Pops a table and makes it the metatable of the table or userdata at `index`.
    pub(crate) fn set_metatable(self, index: c_int) {
        self.table(-1);
        assert!(
            matches!(self.kind(index), Type::Table | Type::UserData),
            "other values share their metatable"
        );
        lua_setmetatable(Top(self), self.slot(index));
    }

    /// Cuts the stack to `top` values.
    pub(crate) fn set_top(self, top: c_int) {
        assert!(
            (0..=lua_gettop(self)).contains(&top),
            "a stack is only cut, never stretched"
        );
        lua_settop(self, Occupied(top));
    }

    /// Removes `count` values from the top.
    pub fn pop(self, count: c_int) {
        let top = lua_gettop(self);
        assert!(
            (0..=top).contains(&count),
            "only what is there can be popped"
        );
        lua_settop(self, Occupied(top - count));
    }

    /// Rotates the values from `index` to the top by one place, up or down.
    pub(super) fn rotate(self, index: c_int, up: bool) {
        let top = lua_gettop(self);
        let from = if index < 0 { top + index + 1 } else { index };
        assert!((1..=top).contains(&from), "only what is there can be moved");
        lua_rotate(self, Occupied(from), if up { 1 } else { -1 });
    }
}

impl<'a> Room<'a> {
    /// Pushes a number.
    pub(super) fn push_number(self, number: f64) -> Top<'a> {
        let stack = self.0;
        lua_pushnumber(self, number);
        Top(stack)
    }

    /// Pushes a string; one that is too long for Lua's allocator is cut.
    pub(crate) fn push_bytes(self, bytes: &[u8]) {
        let bytes = &bytes[..bytes.len().min(MAX_STRING_LENGTH)];
        // SAFETY: there is room, and the bytes are copied.
        unsafe { ffi::lua_pushlstring(self.0.raw(), bytes.as_ptr().cast(), bytes.len()) };
    }
}

impl<'a> Top<'a> {
    /// Pops the value into a list.
    pub(super) fn set_index(self, table: Table, i: i64) -> Room<'a> {
        let stack = self.0;
        lua_rawseti(self, table, i);
        Room(stack)
    }

    /// Puts a key below the value on top.
    pub(super) fn with_name(self, name: &str) -> Pair<'a> {
        let stack = self.0;
        stack.push_bytes(name.as_bytes());
        stack.rotate(-2, true);
        Pair(stack)
    }
}

/// The entries of a table, in Lua's order. While one is looked at, its key and value are on the stack.
pub struct Entries<'a> {
    stack: Stack<'a>,
    table: c_int,
    key: c_int,
    is_first: bool,
}

impl<'a> Stack<'a> {
    /// The entries of the table at `index`, which gets no new fields meanwhile. The key and value on top of the stack are popped by
    /// [`Entries::advance`], together with what has been pushed since.
    pub fn entries(self, index: c_int) -> Entries<'a> {
        let table = self.table(index).0;
        lua_pushnil(self.room_for(3));
        Entries {
            stack: self,
            table,
            key: lua_gettop(self),
            is_first: true,
        }
    }
}

impl Entries<'_> {
    /// The index of the key.
    pub fn key(&self) -> c_int {
        self.key
    }

    /// The index of the value.
    pub fn value(&self) -> c_int {
        self.key + 1
    }

    /// Goes to the next entry; false after the last one, or when the table has lost the current one.
    pub fn advance(&mut self) -> bool {
        let (stack, table) = (self.stack, self.stack.table(self.table));
        stack.set_top(self.key);
        match self.known_key(table) {
            Some(key) => lua_next(key, table) != 0,
            None => {
                stack.pop(1);
                false
            }
        }
    }

    /// Lua raises for a key that the table does not have.
    fn known_key(&mut self, table: Table) -> Option<Known<'_>> {
        let (stack, key) = (self.stack, Slot(self.key));
        if std::mem::take(&mut self.is_first) {
            return (lua_type(stack, key) == ffi::LUA_TNIL).then_some(Known(stack));
        }
        lua_pushvalue(stack.room(), key);
        let is_known = lua_rawget(Top(stack), table) != ffi::LUA_TNIL;
        lua_settop(stack, Occupied(self.key));
        is_known.then_some(Known(stack))
    }
}
