//! Connections of debuggers: for `swanilda debug`, and `--debug` of commands with a simulation.

use std::rc::Rc;
use std::sync::Arc;

use debugger::{Link, Session, Wake};
use io::signals::{InterruptibleThread, reserve_standard_output};
use script::{ask_running_code, interrupt_running_code};
use view::Debugging;

/// The option about debuggers.
#[derive(clap::Args)]
pub(in crate::cli) struct DebugArgs {
    /// Let a debugger connect at PORT of this machine (0: any free port, which is printed), see docs/DEBUGGING.md
    #[arg(long, value_name = "PORT")]
    debug: Option<u16>,
}

impl DebugArgs {
    /// For a command that has a debugger already.
    ///
    /// # Errors
    /// When a port is given.
    pub(in crate::cli) fn refuse(&self, command: &str) -> Result<(), String> {
        match self.debug {
            Some(_) => Err(format!("{command} has its own --port in place of --debug")),
            None => Ok(()),
        }
    }

    /// A session that waits for clients while the simulation runs: at a port, or those of `pages`; None where none is asked for. Scripts run on
    /// this thread.
    ///
    /// # Errors
    /// When the port is not free.
    pub(in crate::cli) fn session(
        &self,
        pages: Option<&Debugging>,
    ) -> Result<Option<Rc<Session>>, String> {
        let link = self.debug.map(listen).transpose()?;
        Ok(match pages {
            Some(pages) => pages.session(link),
            None => link.map(|link| Session::new(link, true)),
        })
    }
}

/// Lets the simulation on this thread look at requests in the middle of code.
fn wake() -> Wake {
    let simulator = InterruptibleThread::current(interrupt_running_code);
    Arc::new(move || {
        ask_running_code();
        simulator.wake();
    })
}

fn failed(error: std::io::Error) -> String {
    format!("the debugger cannot listen: {error}")
}

/// A connection for clients that come to a port, which is printed.
///
/// # Errors
/// When the port is not free.
pub(in crate::cli) fn listen(port: u16) -> Result<Link, String> {
    let (link, address) = Link::listen(port, wake()).map_err(failed)?;
    crate::cli::say(format!("Debugger at {address}\n").as_bytes());
    Ok(link)
}

/// A connection over standard input and output, where nothing else is written from now on.
///
/// # Errors
/// When there can be no more threads.
pub(in crate::cli) fn standard_streams() -> Result<Link, String> {
    let input = std::io::stdin();
    match reserve_standard_output() {
        Some(output) => Link::of_streams(input, output, wake()),
        None => Link::of_streams(input, std::io::stdout(), wake()),
    }
    .map_err(failed)
}
