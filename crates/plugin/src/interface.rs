//! The functions of the simulator, which the plugin looks up in the library whose path it gets. All `unsafe` code is here.

use std::ffi::{CStr, CString, OsStr, c_char, c_int, c_void};
use std::sync::OnceLock;

use super::{Call, Value, stack};

/// What C calls for a function of the plugin.
pub type Callback = extern "C" fn(CallInfo);

/// `SSimInit*`, as the simulator passes it.
#[repr(transparent)]
pub struct InitInfo(*const Init);

#[repr(C)]
struct Init {
    plugin_name: *const c_char,
    host_library: *const c_char,
}

/// `SScriptCallBack*`, as the simulator passes it.
#[repr(transparent)]
pub struct CallInfo(*const Info);

#[repr(C)]
struct Info {
    object: c_int,
    script: c_int,
    stack: c_int,
    wait_until_zero: c_char,
    error: *mut c_char,
    source: *const c_char,
    line: c_int,
}

impl CallInfo {
    /// The stack with the arguments, and on whose behalf the call is.
    pub(super) fn call(&self) -> (i32, Call) {
        // SAFETY: the simulator passes a struct of the interface that lives until the call returns.
        let info = unsafe { &*self.0 };
        (
            info.stack,
            Call {
                script: info.script,
                object: info.object,
            },
        )
    }
}

/// Declares the functions with their names and types, and looks them up.
macro_rules! interface {
    ($($field:ident: $symbol:literal, fn($($arg:ty),*) -> $result:ty;)*) => {
        /// The functions of the simulator.
        pub(super) struct Interface {
            $(pub $field: extern "C" fn($($arg),*) -> $result,)*
        }

        impl Interface {
            fn of(library: &libloading::Library) -> Option<Self> {
                Some(Self { $($field: symbol(library, $symbol)?,)* })
            }
        }
    };
}

interface! {
    add_log: c"simAddLog", fn(*const c_char, c_int, *const c_char) -> c_int;
    set_last_error: c"simSetLastError", fn(*const c_char, *const c_char) -> c_int;
    register_function: c"simRegisterScriptCallbackFunction", fn(*const c_char, *const c_char, Callback) -> c_int;
    call_function: c"simCallScriptFunctionEx", fn(c_int, *const c_char, c_int) -> c_int;
    release_buffer: c"simReleaseBuffer", fn(*const c_void) -> c_int;
    create_stack: c"simCreateStack", fn() -> c_int;
    release_stack: c"simReleaseStack", fn(c_int) -> c_int;
    size: c"simGetStackSize", fn(c_int) -> c_int;
    pop: c"simPopStackItem", fn(c_int, c_int) -> c_int;
    item_type: c"simGetStackItemType", fn(c_int, c_int) -> c_int;
    table_info: c"simGetStackTableInfo", fn(c_int, c_int) -> c_int;
    unfold: c"simUnfoldStackTable", fn(c_int) -> c_int;
    get_bool: c"simGetStackBoolValue", fn(c_int, &mut u8) -> c_int;
    get_int: c"simGetStackInt64Value", fn(c_int, &mut i64) -> c_int;
    get_double: c"simGetStackDoubleValue", fn(c_int, &mut f64) -> c_int;
    get_string: c"simGetStackStringValue", fn(c_int, &mut c_int) -> *mut c_char;
    push_null: c"simPushNullOntoStack", fn(c_int) -> c_int;
    push_bool: c"simPushBoolOntoStack", fn(c_int, bool) -> c_int;
    push_int: c"simPushInt64OntoStack", fn(c_int, i64) -> c_int;
    push_double: c"simPushDoubleOntoStack", fn(c_int, f64) -> c_int;
    push_text: c"simPushTextOntoStack", fn(c_int, *const c_char) -> c_int;
    push_string: c"simPushStringOntoStack", fn(c_int, *const c_char, c_int) -> c_int;
    push_table: c"simPushTableOntoStack", fn(c_int) -> c_int;
    insert: c"simInsertDataIntoStackTable", fn(c_int) -> c_int;
}

static INTERFACE: OnceLock<Interface> = OnceLock::new();

impl Interface {
    pub fn get() -> Option<&'static Self> {
        INTERFACE.get()
    }

    /// Opens the simulator's library. It stays open, as its functions are used from now on.
    pub fn find(info: &InitInfo) -> Option<&'static Self> {
        if let Some(interface) = Self::get() {
            return Some(interface);
        }
        // SAFETY: the simulator passes a struct of the interface with a text that ends with NUL.
        let path = unsafe { CStr::from_ptr((*info.0).host_library) }
            .to_str()
            .ok()?;
        // SAFETY: it is the library of the simulator that has loaded the plugin, and already open.
        let library = unsafe { libloading::Library::new(OsStr::new(path)) }.ok()?;
        let interface = Self::of(&library)?;
        std::mem::forget(library);
        Some(INTERFACE.get_or_init(|| interface))
    }

    pub fn register(&self, name: &str, callback: Callback) -> bool {
        CString::new(name).is_ok_and(|name| {
            (self.register_function)(name.as_ptr(), std::ptr::null(), callback) >= 0
        })
    }

    pub fn set_error(&self, text: &str) {
        // The text is cut at the first NUL.
        let text = CString::new(text.split('\0').next().unwrap_or_default()).unwrap_or_default();
        (self.set_last_error)(std::ptr::null(), text.as_ptr());
    }

    pub fn log(&self, origin: &str, level: i32, text: &str) -> Result<(), String> {
        let (origin, text) = (c_text(origin)?, c_text(text)?);
        (self.add_log)(origin.as_ptr(), level, text.as_ptr());
        Ok(())
    }

    pub fn call_script(
        &self,
        script: i32,
        function: &str,
        args: &[Value],
    ) -> Result<Vec<Value>, String> {
        let name = c_text(function)?;
        let items = (self.create_stack)();
        args.iter().for_each(|arg| stack::push(self, items, arg));
        let outcome = (self.call_function)(script, name.as_ptr(), items);
        let results = stack::take(self, items);
        (self.release_stack)(items);
        if outcome >= 0 {
            Ok(results)
        } else {
            Err(format!("the call of {function} failed."))
        }
    }

    /// The text on top of a stack.
    pub fn text(&self, stack: i32) -> Vec<u8> {
        let mut length = 0;
        let text = (self.get_string)(stack, &mut length);
        if text.is_null() {
            return Vec::new();
        }
        // SAFETY: the simulator has made a buffer with so many bytes, which nobody else has.
        let bytes = unsafe {
            std::slice::from_raw_parts(text.cast::<u8>(), usize::try_from(length).unwrap_or(0))
        };
        let bytes = bytes.to_vec();
        (self.release_buffer)(text.cast());
        bytes
    }
}

fn c_text(text: &str) -> Result<CString, String> {
    CString::new(text).map_err(|_| "texts of the interface have no NUL in them.".to_owned())
}

/// A function by the type that the interface says it has.
fn symbol<F: Copy>(library: &libloading::Library, name: &CStr) -> Option<F> {
    const {
        assert!(
            size_of::<F>() == size_of::<usize>(),
            "a function is an address"
        );
    };
    // SAFETY: the types are those of the interface, and the library stays open.
    unsafe { library.get::<F>(name.to_bytes_with_nul()) }
        .ok()
        .map(|symbol| *symbol)
}
