//! Shared libraries: how they are opened, and their entry points.

use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;

use super::memory::Value;

/// What C calls for each function of the simulator: number of the row, values, their number.
pub(crate) type Entrance = extern "C" fn(u32, *mut Value, u32) -> i64;

/// An exception may come out of any function of a plugin. Rust cannot catch it, but ends the process in a defined way.
type Init = extern "C-unwind" fn(*mut InitInfo) -> c_int;
type Cleanup = extern "C-unwind" fn();
type Receive = extern "C-unwind" fn(*mut MessageInfo);
pub(super) type CallbackEntry = extern "C-unwind" fn(*mut CallbackInfo);

/// `SSimInit` of the interface.
#[repr(C)]
struct InitInfo {
    plugin_name: *const c_char,
    host_library: *const c_char,
}

/// `SSimMsg` of the interface.
#[repr(C)]
struct MessageInfo {
    id: c_int,
    values: *mut c_int,
    data: *mut c_void,
}

/// `SScriptCallBack` of the interface.
#[repr(C)]
pub(super) struct CallbackInfo {
    object: c_int,
    script: c_int,
    stack: c_int,
    wait_until_zero: c_char,
    error: *mut c_char,
    source: *const c_char,
    line: c_int,
}

/// Bytes of the buffer in which plugins of the older kind leave an error.
const ERROR_BUFFER: usize = 258;

/// A plugin's library. It is never closed: its functions and threads may be in use.
#[derive(Clone, Copy)]
pub(crate) struct Library {
    init: Init,
    cleanup: Option<Cleanup>,
    receive: Option<Receive>,
}

/// A message to a plugin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Message {
    pub id: c_int,
    pub values: [c_int; 4],
}

/// A function that a plugin or a program has registered for scripts.
#[derive(Debug, Clone, Copy)]
pub struct Callback(pub(super) CallbackEntry);

/// On whose behalf a callback runs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Caller {
    /// The object that the script is attached to, or -1.
    pub object: i32,
    pub script: i32,
    pub stack: i32,
}

impl Library {
    /// Opens a plugin; this runs the code that the library runs when it is loaded.
    ///
    /// # Errors
    /// When it cannot be opened, or is no plugin.
    pub fn open(path: &Path) -> Result<Self, String> {
        let library = open(path)?;
        let plugin = Self {
            init: symbol(&library, c"simInit").ok_or("missing init entry point in plugin")?,
            cleanup: symbol(&library, c"simCleanup"),
            receive: symbol(&library, c"simMsg"),
        };
        std::mem::forget(library);
        Ok(plugin)
    }

    /// Starts the plugin; its version, or 0 where it failed.
    pub fn start(&self, name: &str, host_library: &Path) -> i32 {
        let (Ok(name), Some(host_library)) = (CString::new(name), c_path(host_library)) else {
            return 0;
        };
        let mut info = InitInfo {
            plugin_name: name.as_ptr(),
            host_library: host_library.as_ptr(),
        };
        (self.init)(&raw mut info)
    }

    pub fn clean_up(&self) {
        self.cleanup.into_iter().for_each(|cleanup| cleanup());
    }

    pub fn receive(&self, mut message: Message) {
        let Some(receive) = self.receive else { return };
        let mut info = MessageInfo {
            id: message.id,
            values: message.values.as_mut_ptr(),
            data: ptr::null_mut(),
        };
        receive(&raw mut info);
    }
}

impl Callback {
    /// Calls it; the error it left in the older way, if it did.
    pub(crate) fn call(self, caller: Caller) -> Option<String> {
        let mut error = [0 as c_char; ERROR_BUFFER];
        let mut info = CallbackInfo {
            object: caller.object,
            script: caller.script,
            stack: caller.stack,
            wait_until_zero: 0,
            error: error.as_mut_ptr(),
            source: c"".as_ptr(),
            line: 0,
        };
        (self.0)(&raw mut info);
        let bytes: Vec<u8> = error
            .iter()
            .map(|&byte| byte.cast_unsigned())
            .take_while(|&byte| byte != 0)
            .collect();
        (!bytes.is_empty()).then(|| String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// Opens the simulator's own library, through which plugins call, and connects it with `entrance`. It stays open.
///
/// # Errors
/// When it cannot be opened.
pub(crate) fn connect(path: &Path, entrance: Entrance) -> Result<(), String> {
    let library = open(path)?;
    let connect: extern "C" fn(Entrance) =
        symbol(&library, c"swanilda_connect").ok_or("it is damaged")?;
    connect(entrance);
    std::mem::forget(library);
    Ok(())
}

fn open(path: &Path) -> Result<libloading::Library, String> {
    // SAFETY: loading runs the library's code, which the user has allowed (`Permissions::can_load_native`).
    unsafe { libloading::Library::new(path) }.map_err(|error| {
        // The system's words are in the cause.
        std::error::Error::source(&error).map_or_else(|| error.to_string(), ToString::to_string)
    })
}

/// A function of a library, by the type that the interface says it has.
fn symbol<F: Copy>(library: &libloading::Library, name: &std::ffi::CStr) -> Option<F> {
    const {
        assert!(
            size_of::<F>() == size_of::<usize>(),
            "a function is an address"
        );
    };
    // SAFETY: the types are those of the interface, and the libraries stay open.
    unsafe { library.get::<F>(name.to_bytes_with_nul()) }
        .ok()
        .map(|symbol| *symbol)
}

fn c_path(path: &Path) -> Option<CString> {
    CString::new(path.to_str()?).ok()
}
