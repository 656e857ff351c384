//! Userdata that refer to objects of a library by a class and a number.
//!
//! Changes that a script makes to such a value (its metatable, its finalizer) can at worst make it refer to another object of the same state or
//! to none: the library looks the number up.

use std::ffi::{CStr, c_int};

use mlua::ffi;

use super::stack::{Stack, Type};

/// Metatables by class, and classes by metatable.
const CLASSES: &CStr = c"swanilda.classes";

/// The content of a userdata.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LuaObject {
    /// The number of its class in the library.
    pub class: i64,
    /// The number by which the library finds the object.
    pub id: i64,
}

impl Stack<'_> {
    /// Pops a table, which becomes the metatable of the objects of `class`. Its `__gc` must be there by now.
    pub fn define_class(self, class: i64) {
        if self.push_registry(CLASSES) != Type::Table {
            self.pop(1);
            self.new_table(0, 0);
            self.push_value(-1);
            self.set_registry(CLASSES);
        }
        self.push_value(-2);
        self.raw_set_index(-2, class);
        self.push_value(-2);
        self.push_int(class);
        self.raw_set(-3);
        self.pop(2);
    }

    /// Pushes an object of a class that is defined.
    pub(crate) fn push_object(self, object: LuaObject) {
        let _room = self.room();
        // SAFETY: there is room for one value. Pushes a block of that size, which Lua aligns for every type; it is written before anybody sees it.
        unsafe {
            let block =
                ffi::lua_newuserdatauv(self.raw(), size_of::<LuaObject>(), 0).cast::<LuaObject>();
            block.write(object);
        }
        if self.push_registry(CLASSES) == Type::Table
            && self.raw_get_index(-1, object.class) == Type::Table
        {
            self.remove(-2);
            self.set_metatable(-2);
        }
    }

    /// The object at `index`.
    pub(crate) fn object(self, index: c_int) -> Option<LuaObject> {
        if self.kind(index) != Type::UserData
            || self.raw_len(index) != size_of::<LuaObject>()
            || !self.push_metatable(index)
        {
            return None;
        }
        let class = if self.push_registry(CLASSES) == Type::Table {
            self.insert(-2);
            self.raw_get(-2);
            self.integer(-1)
        } else {
            None
        };
        self.pop(2);
        // SAFETY: a userdata of that size, which stays on the stack while it is copied; every pattern of bits is an object.
        let object = unsafe {
            ffi::lua_touserdata(self.raw(), index)
                .cast::<LuaObject>()
                .read()
        };
        class.filter(|&class| class == object.class).map(|_| object)
    }
}
