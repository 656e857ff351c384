//! What the commands with a simulation do first: read the files, make the simulator, fill its scene, listen to programs outside.

use std::path::{Path, PathBuf};

use super::interrupt::Interrupt;
use super::output::Output;
use super::progress::Progress;
use super::setup::{Setup, Sources};
use super::watchdog::Watchdog;
use crate::cli::remote::Remote;
use capture::Tape;
use simulator::{Builder, Options, RunLimits, ScriptKind, Simulator};
use view::Debugging;

/// A simulator of the command line, and what reports about it.
pub(in crate::cli) struct Launch<'a> {
    setup: &'a Setup,
    scene: Option<&'a Path>,
    sources: Sources,
    pub sim: Simulator,
    pub output: Output,
    pub interrupt: Interrupt,
    pub watchdog: Watchdog,
}

/// What is around a simulator.
struct Around {
    interrupt: Interrupt,
    output: Output,
    watchdog: Watchdog,
    plugin_note: Option<PathBuf>,
}

impl<'a> Launch<'a> {
    /// Reads the files, and makes a simulator without a scene. Without `remote`, nothing listens, and scripts may do everything. `plugin_note`: see
    /// [`Options::plugin_note`]. Everything comes from outside by the tape. `pages`: those of a viewer, which debug scripts.
    ///
    /// # Errors
    /// When a file cannot be read.
    pub(in crate::cli) fn new(
        setup: &'a Setup,
        remote: Option<&Remote>,
        scene: Option<&'a Path>,
        progress: &Progress,
        plugin_note: Option<PathBuf>,
        tape: &Tape,
        pages: Option<&Debugging>,
    ) -> Result<Self, String> {
        let interrupt = Interrupt::of_scripts_here();
        let around = Around {
            watchdog: interrupt.watchdog(setup.has_own_messages()),
            output: setup.output(progress, &interrupt),
            interrupt,
            plugin_note,
        };
        let session = setup.debug.session(pages)?;
        let console = Box::new(around.output.clone());
        Self::made(setup, remote, scene, tape, around, |builder| {
            let builder = builder.console(console);
            match session {
                Some(session) => builder.debugger(session),
                None => builder,
            }
        })
    }

    /// The same for a replay whose surroundings are others: `build` adds a console, and a debugger if there is one.
    ///
    /// # Errors
    /// When a file cannot be read.
    pub(in crate::cli) fn played(
        setup: &'a Setup,
        remote: &Remote,
        scene: Option<&'a Path>,
        tape: &Tape,
        interrupt: &Interrupt,
        build: impl FnOnce(Builder) -> Builder,
    ) -> Result<Self, String> {
        let progress = Progress::new(RunLimits::default(), true);
        let around = Around {
            watchdog: Watchdog::default(),
            output: setup.output(&progress, interrupt).silenced(),
            interrupt: interrupt.clone(),
            plugin_note: None,
        };
        Self::made(setup, Some(remote), scene, tape, around, build)
    }

    fn made(
        setup: &'a Setup,
        remote: Option<&Remote>,
        scene: Option<&'a Path>,
        tape: &Tape,
        around: Around,
        build: impl FnOnce(Builder) -> Builder,
    ) -> Result<Self, String> {
        let Around {
            interrupt,
            output,
            watchdog,
            plugin_note,
        } = around;
        let sources = setup.sources(scene, tape)?;
        let options = Options {
            plugin_note,
            ..setup.options(scene, &interrupt)
        };
        let options = match remote {
            Some(remote) => remote.guard(options),
            None => options,
        };
        let options = Options {
            permissions: options.permissions.on_tape(tape),
            ..options
        };
        let sim = build(Simulator::builder().options(options)).build();
        Ok(Self {
            setup,
            scene,
            sources,
            sim,
            output,
            interrupt,
            watchdog,
        })
    }

    /// Fills the scene; `kind` is that of a script that is the scene.
    pub(in crate::cli) fn fill(&mut self, kind: ScriptKind) {
        let sources = std::mem::take(&mut self.sources);
        self.setup.fill(&mut self.sim, sources, kind, self.scene);
    }

    /// Starts the remote APIs: ZeroMQ if `zmq`, the others on request.
    ///
    /// # Errors
    /// When a port is not free.
    pub(in crate::cli) fn serve(&mut self, remote: &Remote, zmq: bool) -> Result<(), String> {
        remote.serve(
            zmq,
            self.setup,
            &mut self.sim,
            &self.output,
            &self.interrupt,
        )
    }
}
