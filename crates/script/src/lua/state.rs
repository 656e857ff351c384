//! A Lua state and its memory.

use std::ffi::c_void;
use std::ptr::{NonNull, null_mut};
use std::rc::Rc;

use mlua::{Lua, LuaOptions, StdLib, ffi};

use super::pool::{Allocator, Pool};
use super::random_state::RandomState;
use super::{Owner, Stack};
use crate::budget::Budget;

/// A Lua state with the standard libraries. mlua owns it: it is closed when the last [`Lua`] of it is dropped.
pub(crate) struct State {
    lua: Lua,
    main: NonNull<ffi::lua_State>,
    random: RandomState,
}

/// Data that a state needs until it is closed. It is application data of mlua, which drops it after closing.
struct Foundation {
    pool: NonNull<Pool>,
    _owner: Rc<Owner>,
}

impl Drop for Foundation {
    fn drop(&mut self) {
        // SAFETY: leaked by `install_pool`; the state is closed, so nothing of it is left in the pool.
        drop(unsafe { Box::from_raw(self.pool.as_ptr()) });
    }
}

impl State {
    /// A new state of that owner, whose budget its memory counts against.
    pub(crate) fn new(owner: Owner) -> Self {
        let owner = Rc::new(owner);
        // SAFETY: what makes this unsafe is what scripts may load: native libraries and bytecode. They may as in the original, or,
        // where `Options::permissions` do not allow native code, start-up takes both away before a script runs.
        let new = || unsafe { Lua::unsafe_new_with(StdLib::NONE, LuaOptions::default()) };
        let lua = heap::in_scripts(new);
        if owner.budget.is_limited() {
            // From here on mlua expects memory to be refused, and allocates in protected calls only. The limit itself is the budget's.
            lua.set_memory_limit(usize::MAX)
                .expect("the state has the allocator of mlua");
        }
        let main = main_coroutine(&lua);
        owner.budget.resize(0, lua.used_memory());
        let pool = install_pool(main, Rc::clone(&owner.budget));
        set_owner(main, &owner);
        lua.set_app_data(Foundation {
            pool,
            _owner: owner,
        });
        // SAFETY: opens libraries in a protected call; the closure owns nothing.
        let opened = unsafe { lua.exec_raw::<()>((), |raw| ffi::luaL_openlibs(raw)) };
        opened.expect("the standard libraries open in an empty state");
        // SAFETY: the state lives, and its libraries are as Lua made them.
        let random = RandomState::of(unsafe { Stack::from_raw(main.as_ptr()) });
        Self { lua, main, random }
    }

    /// The state of `math.random`; None where Lua keeps it in another way.
    pub(crate) fn random_state(&self) -> Option<[u64; 4]> {
        self.random.read()
    }

    /// Sets the state of `math.random`; false where Lua keeps it in another way.
    pub(crate) fn set_random_state(&self, words: [u64; 4]) -> bool {
        self.random.write(words)
    }

    /// The virtual machine, for what is not hot.
    pub(crate) fn lua(&self) -> &Lua {
        &self.lua
    }

    /// The stack of the main coroutine.
    pub(crate) fn stack(&self) -> Stack<'_> {
        // SAFETY: the state lives as long as `lua`, and that as long as the borrow.
        unsafe { Stack::from_raw(self.main.as_ptr()) }
    }
}

fn main_coroutine(lua: &Lua) -> NonNull<ffi::lua_State> {
    let mut main = null_mut();
    // SAFETY: the closure owns nothing and calls nothing.
    let called = unsafe { lua.exec_raw::<()>((), |raw| main = raw) };
    called.expect("a closure that does nothing cannot fail");
    NonNull::new(main).expect("Lua calls with a state")
}

/// Puts a pool below a state. The allocator of mlua stays below the pool; its counter, three words, is never freed, since mlua frees
/// it with the state only where its allocator is still on top.
fn install_pool(main: NonNull<ffi::lua_State>, budget: Rc<Budget>) -> NonNull<Pool> {
    let mut data = null_mut();
    // SAFETY: the state is new and has the allocator of mlua, which aborts when memory is out, aligns its blocks to 16 bytes (checked
    // in `pool`), and counts in memory that is never freed. So it can be called for as long as the pool is there; the pool sends back to it
    // what came from it. The pool itself is leaked: `Foundation` frees it when the state is closed.
    unsafe {
        let function = ffi::lua_getallocf(main.as_ptr(), &raw mut data);
        let pool = NonNull::from(Box::leak(Box::new(Pool::new(
            budget,
            Allocator { function, data },
        ))));
        ffi::lua_setallocf(main.as_ptr(), allocate, pool.as_ptr().cast());
        if let Some(scripts) = heap::Scripts::current() {
            scripts.abandon_block();
        }
        pool
    }
}

/// Lets every coroutine find the owner. Later ones copy the extra space of the main one; those that mlua has made are in the registry, and
/// finalizers may run on them.
fn set_owner(main: NonNull<ffi::lua_State>, owner: &Rc<Owner>) {
    let (main, owner) = (main.as_ptr(), Rc::as_ptr(owner));
    // SAFETY: mlua leaves the extra space alone in this version of Lua. The traversal of the registry changes nothing in it and needs
    // two slots, which an empty stack has.
    unsafe {
        ffi::lua_getextraspace(main)
            .cast::<*const Owner>()
            .write(owner);
        ffi::lua_pushnil(main);
        while ffi::lua_next(main, ffi::LUA_REGISTRYINDEX) != 0 {
            let coroutine = ffi::lua_tothread(main, -1);
            if !coroutine.is_null() {
                ffi::lua_getextraspace(coroutine)
                    .cast::<*const Owner>()
                    .write(owner);
            }
            ffi::lua_settop(main, -2);
        }
    }
}

/// The largest block a state may ask for. Beyond it Lua raises `not enough memory`, which only Lua code can bring about: what Rust
/// pushes is smaller (see `Stack::push_bytes` and `Stack::new_table`), and mlua protects what may be larger.
const MAX_BLOCK: usize = 2 << 30;

/// Lua's allocator. Out of memory ends the process, as it does everywhere in Rust.
unsafe extern "C" fn allocate(
    pool: *mut c_void,
    old: *mut c_void,
    old_size: usize,
    size: usize,
) -> *mut c_void {
    // SAFETY: `install_pool` gave a pool that outlives the state, which is used from one thread; Lua passes the size it requested.
    unsafe {
        let pool = &mut *pool.cast::<Pool>();
        // Without an old block, Lua passes the type of the value instead of a size.
        let counted = if old.is_null() { 0 } else { old_size };
        if size > MAX_BLOCK || !pool.budget.resize(counted, size) {
            return null_mut();
        }
        pool.allocate(old, old_size, size)
    }
}

#[cfg(test)]
mod tests {
    use std::ptr::null_mut;

    use mlua::ffi;

    use super::MAX_BLOCK;
    use crate::lua::tests::with_state;

    #[test]
    fn a_block_that_may_not_grow_stays_as_it_was() {
        with_state(|state| {
            let mut pool = null_mut();
            // SAFETY: a block of that size is requested, refused another size, and freed.
            unsafe {
                let allocate = ffi::lua_getallocf(state.main.as_ptr(), &raw mut pool);
                for size in [8, 1000] {
                    let block = allocate(pool, null_mut(), 0, size);
                    block.cast::<u8>().write_bytes(7, size);
                    assert!(allocate(pool, block, size, MAX_BLOCK + 1).is_null());
                    assert!((0..size).all(|i| block.cast::<u8>().add(i).read() == 7));
                    assert!(allocate(pool, block, size, 0).is_null());
                }
                assert!(allocate(pool, null_mut(), 0, MAX_BLOCK + 1).is_null());
            }
        });
    }

    #[test]
    fn a_state_frees_all_that_it_counted() {
        let budget = with_state(|state| {
            state
                .lua
                .load("for i = 1, 1000 do _G['x' .. i] = {i, ('y'):rep(i)} end coroutine = nil")
                .exec()
                .expect("runs");
            state.stack().owner().budget.clone()
        });
        assert_eq!(budget.used(), 0);
    }
}
