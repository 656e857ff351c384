//! Functions of C's library that open and close files, as Lua calls them: no snapshot of a simulator reaches what is open.

use std::collections::BTreeMap;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::sync::{Mutex, PoisonError};

use heap::outside;
use heap::resource::Resource;

/// C's type of open files.
#[repr(transparent)]
struct File(c_void);

/// What Lua has open, by address.
static OPEN: Mutex<BTreeMap<usize, Resource>> = Mutex::new(BTreeMap::new());

// SAFETY: as declared in stdio.h.
unsafe extern "C" {
    fn fopen(name: *const c_char, mode: *const c_char) -> *mut File;
    fn popen(command: *const c_char, mode: *const c_char) -> *mut File;
    safe fn tmpfile() -> *mut File;
    fn fclose(file: *mut File) -> c_int;
    fn pclose(file: *mut File) -> c_int;
}

fn note_opened(file: *mut File, name: impl FnOnce() -> String) -> *mut File {
    if !file.is_null() {
        let resource = Resource::new(name);
        outside(|| open().insert(file.addr(), resource));
    }
    file
}

/// Before it is closed: then another file may have the address.
fn note_closed(file: *mut File) {
    outside(|| drop(open().remove(&file.addr())));
}

fn open() -> std::sync::MutexGuard<'static, BTreeMap<usize, Resource>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// # Safety
/// It is text that ends with a zero.
unsafe fn text(pointer: *const c_char) -> String {
    // SAFETY: as promised.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_string_lossy().into_owned()
}

/// `fopen` for Lua.
///
/// # Safety
/// As that of C.
// SAFETY: nothing else has a name that begins like this.
#[unsafe(no_mangle)]
unsafe extern "C" fn swanilda_fopen(name: *const c_char, mode: *const c_char) -> *mut File {
    // SAFETY: as promised.
    unsafe { note_opened(fopen(name, mode), || format!("the file {}", text(name))) }
}

/// `popen` for Lua.
///
/// # Safety
/// As that of C.
// SAFETY: nothing else has a name that begins like this.
#[unsafe(no_mangle)]
unsafe extern "C" fn swanilda_popen(command: *const c_char, mode: *const c_char) -> *mut File {
    // SAFETY: as promised.
    unsafe {
        note_opened(popen(command, mode), || {
            format!("the program {}", text(command))
        })
    }
}

/// `tmpfile` for Lua.
// SAFETY: nothing else has a name that begins like this.
#[unsafe(no_mangle)]
extern "C" fn swanilda_tmpfile() -> *mut File {
    note_opened(tmpfile(), || "a temporary file".to_owned())
}

/// `fclose` for Lua.
///
/// # Safety
/// As that of C.
// SAFETY: nothing else has a name that begins like this.
#[unsafe(no_mangle)]
unsafe extern "C" fn swanilda_fclose(file: *mut File) -> c_int {
    note_closed(file);
    // SAFETY: as promised.
    unsafe { fclose(file) }
}

/// `pclose` for Lua.
///
/// # Safety
/// As that of C.
// SAFETY: nothing else has a name that begins like this.
#[unsafe(no_mangle)]
unsafe extern "C" fn swanilda_pclose(file: *mut File) -> c_int {
    note_closed(file);
    // SAFETY: as promised.
    unsafe { pclose(file) }
}
