//! Files, programs and the environment: what of `io` and `os` needs a permission.

use std::path::{Path, PathBuf};

use super::super::calls::guard::{Next, guarded, install as guard};
use super::super::{Stack, Type};
use super::{c_text, or_raise, path, permissions, unless_denied};
use permissions::{Denied, Permissions};

pub(super) fn install(stack: Stack<'_>) {
    stack.push_global("io");
    guard::<{ guarded::IO_OPEN }, _>(stack, "open", open);
    guard::<{ guarded::IO_LINES }, _>(stack, "lines", read_named);
    guard::<{ guarded::IO_INPUT }, _>(stack, "input", read_named);
    guard::<{ guarded::IO_OUTPUT }, _>(stack, "output", write_named);
    guard::<{ guarded::IO_POPEN }, _>(stack, "popen", run);
    guard::<{ guarded::IO_TMPFILE }, _>(stack, "tmpfile", temporary_file);
    stack.pop(1);
    stack.push_global("os");
    guard::<{ guarded::OS_EXECUTE }, _>(stack, "execute", execute);
    guard::<{ guarded::OS_GETENV }, _>(stack, "getenv", environment);
    guard::<{ guarded::OS_REMOVE }, _>(stack, "remove", remove);
    guard::<{ guarded::OS_RENAME }, _>(stack, "rename", rename);
    guard::<{ guarded::OS_TMPNAME }, _>(stack, "tmpname", temporary_name);
    stack.pop(1);
}

fn open(stack: Stack<'_>) -> Next {
    let Some(path) = path(stack, 1) else {
        return Next::Original;
    };
    let mode = c_text(stack, 2).unwrap_or_else(|| b"r".to_vec());
    unless_denied(stack, check_mode(permissions(stack), &path, &mode))
}

/// Lua's function reports an invalid mode.
fn check_mode(permissions: &Permissions, path: &Path, mode: &[u8]) -> Result<(), Denied> {
    let is_both = mode.contains(&b'+');
    if is_both || mode.starts_with(b"r") {
        permissions.check_read(path)?;
    }
    if is_both || !mode.starts_with(b"r") {
        permissions.check_write(path)
    } else {
        Ok(())
    }
}

/// `io.lines` and `io.input`: of a file by name, if there is a name.
fn read_named(stack: Stack<'_>) -> Next {
    path(stack, 1).map_or(Next::Original, |path| {
        or_raise(stack, permissions(stack).check_read(&path))
    })
}

fn write_named(stack: Stack<'_>) -> Next {
    path(stack, 1).map_or(Next::Original, |path| {
        or_raise(stack, permissions(stack).check_write(&path))
    })
}

fn run(stack: Stack<'_>) -> Next {
    let command = c_text(stack, 1).unwrap_or_default();
    or_raise(
        stack,
        permissions(stack).check_run(&String::from_utf8_lossy(&command)),
    )
}

/// Without a command it returns whether there is a shell.
fn execute(stack: Stack<'_>) -> Next {
    if !matches!(stack.kind(1), Type::None | Type::Nil) || permissions(stack).can_run() {
        return run(stack);
    }
    stack.push_bool(false);
    Next::Return(1)
}

fn environment(stack: Stack<'_>) -> Next {
    unless_denied(stack, permissions(stack).check_environment())
}

fn remove(stack: Stack<'_>) -> Next {
    path(stack, 1).map_or(Next::Original, |path| {
        unless_denied(stack, permissions(stack).check_write_entry(&path))
    })
}

fn rename(stack: Stack<'_>) -> Next {
    let (Some(old), Some(new)) = (path(stack, 1), path(stack, 2)) else {
        return Next::Original;
    };
    unless_denied(stack, permissions(stack).check_rename(&old, &new))
}

/// A file that has no name, in the folder where the system has those.
fn temporary_file(stack: Stack<'_>) -> Next {
    unless_denied(stack, permissions(stack).check_write(&temporary()))
}

fn temporary_name(stack: Stack<'_>) -> Next {
    or_raise(stack, permissions(stack).check_write(&temporary()))
}

/// The folder of Lua's temporary files.
fn temporary() -> PathBuf {
    if cfg!(unix) {
        "/tmp/lua_XXXXXX".into()
    } else {
        std::env::temp_dir().join("lua_XXXXXX")
    }
}
