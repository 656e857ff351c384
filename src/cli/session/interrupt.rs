//! Ctrl-c: the first one asks for a clean end, the second one ends at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set when the user interrupts the program.
pub(in crate::cli) struct Interrupt {
    requested: Arc<AtomicBool>,
}

impl Interrupt {
    /// Installs the handler; `code` is the exit code after a second interrupt.
    pub(in crate::cli) fn install(code: u8) -> Self {
        let requested = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&requested);
        let listening = ctrlc::set_handler(move || {
            if flag.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(code));
            }
        });
        if let Err(error) = listening {
            // Then ctrl-c does what the system does by default.
            eprintln!("swanilda: cannot listen for ctrl-c: {error}");
        }
        Self { requested }
    }

    /// Becomes true on the first interrupt.
    pub(in crate::cli) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.requested)
    }

    pub(in crate::cli) fn is_requested(&self) -> bool {
        self.requested.load(Ordering::Relaxed)
    }
}
