//! `swanilda view`: a scene in a browser; and the options about that of `run` and `serve`.

mod played;

use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use super::Outcome;
use super::capture::{CaptureArgs, finish};
use super::interrupt::Interrupt;
use super::launch::Launch;
use super::live::Live;
use super::output::Output;
use super::progress::Progress;
use super::remote::Remote;
use super::replay::{Captured, CommandLoop, is_capture};
use super::run::Kind;
use super::setup::Setup;
use super::watchdog::Watchdog;
use capture::Tape;
use simulator::{Builder, RunLimits, Simulator};
use view::{Debugging, RecordedViewer, Viewer};

/// Interval between checks for ctrl-c while a recording is shown.
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// Show a scene, a capture or a recording in a browser
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene: a Lua file, a CoppeliaSim file, a folder made by unpack, a capture (.swc), or a recording (.swr) [default: the default scene]
    scene: Option<PathBuf>,
    /// Script type to load the file as
    #[arg(long = "as", value_name = "KIND", default_value = "customization")]
    kind: Kind,
    /// Do not start the simulation: the play button does
    #[arg(long)]
    paused: bool,
    /// So many times as fast as the wall clock; 0: as fast as possible
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = factor, allow_negative_numbers = true)]
    speed: f64,
    /// Do not open a browser
    #[arg(long)]
    no_open: bool,
    /// What pages may do
    #[arg(
        long,
        value_name = "MODE",
        default_value = "full",
        require_equals = true
    )]
    view: Mode,
    /// Port of the page [default: any free one]
    #[arg(long, value_name = "PORT", default_value_t = 0)]
    port: u16,
    #[command(flatten)]
    remote: Remote,
    #[command(flatten)]
    pub(super) capture: CaptureArgs,
    #[command(flatten)]
    pub(super) setup: Setup,
}

/// Viewer options
#[derive(clap::Args)]
pub(super) struct ViewArgs {
    /// Show the scene in browsers, at an address that is printed; read-only: pages can change nothing
    #[arg(long, value_name = "MODE", num_args = 0..=1, require_equals = true, default_missing_value = "full")]
    view: Option<Mode>,
    /// Port of the page [default: any free one]
    #[arg(long = "view-port", value_name = "PORT", default_value_t = 0)]
    port: u16,
}

/// What pages may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Mode {
    Full,
    ReadOnly,
}

impl Mode {
    fn debugging(self, tape: &Tape) -> Debugging {
        Debugging::new(self == Self::ReadOnly, tape.is_on())
    }
}

impl ViewArgs {
    /// Starts the viewer, if it is asked for.
    ///
    /// # Errors
    /// When the port is not free.
    pub(super) fn start(
        &self,
        sim: &Simulator,
        pages: Option<&Debugging>,
        remote: &Remote,
        output: &Output,
        watchdog: &Watchdog,
    ) -> Result<Option<Viewer>, String> {
        match pages {
            Some(pages) => start(sim, pages, self.port, remote, output, watchdog),
            None => Ok(None),
        }
    }

    /// What pages debug with, if there are to be any.
    pub(super) fn debugging(&self, tape: &Tape) -> Option<Debugging> {
        let mode = self.view?;
        (!tape.is_replaying()).then(|| mode.debugging(tape))
    }

    /// Whether it is asked for.
    pub(super) fn is_asked_for(&self) -> bool {
        self.view.is_some()
    }
}

/// Starts a viewer and prints its address. A replay has none.
fn start(
    sim: &Simulator,
    pages: &Debugging,
    port: u16,
    remote: &Remote,
    output: &Output,
    watchdog: &Watchdog,
) -> Result<Option<Viewer>, String> {
    if sim.tape().is_replaying() {
        return Ok(None);
    }
    let failed = |error: std::io::Error| format!("the viewer cannot start at port {port}: {error}");
    let listener = TcpListener::bind((remote.address(), port)).map_err(failed)?;
    let viewer = Viewer::start_with(sim, listener, pages).map_err(failed)?;
    watchdog.show_on(viewer.busy_sign());
    output.viewing(&viewer.url());
    Ok(Some(viewer))
}

/// Shows the scene until ctrl-c, SIGTERM or `quitSimulator()`.
pub(super) fn view(args: &Args) -> Outcome {
    let scene = args.scene.as_deref();
    if let Some(recording) = scene.filter(|scene| is_recording(scene)) {
        return view_recording(args, recording);
    }
    if let Some(file) = scene.filter(|scene| is_capture(scene)) {
        return played::view(args, file);
    }
    let progress = Progress::new(RunLimits::default(), true);
    let tape = args.capture.tape()?;
    let pages = args.view.debugging(&tape);
    let mut launch = Launch::new(
        &args.setup,
        Some(&args.remote),
        scene,
        &progress,
        None,
        &tape,
        Some(&pages),
    )?;
    // Before the scripts, so that pages have their first lines as well.
    let viewer = start(
        &launch.sim,
        &pages,
        args.port,
        &args.remote,
        &launch.output,
        &launch.watchdog,
    )?;
    args.fill(&mut launch, &tape)?;
    let Launch {
        mut sim, interrupt, ..
    } = launch;
    if let Some(viewer) = &viewer {
        args.open_browser(&viewer.url());
    }
    args.begin(&mut sim);
    let code = Live::new(viewer).run(&mut sim, &interrupt);
    drop(sim);
    finish(&tape);
    Ok(code)
}

fn is_recording(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("swr"))
}

/// Shows a recording until ctrl-c or SIGTERM.
fn view_recording(args: &Args, path: &Path) -> Outcome {
    let recording = super::export::open(path)?;
    let interrupt = Interrupt::of_scripts_here();
    let listener = args.listen()?;
    let viewer = RecordedViewer::start(recording, listener).map_err(|error| args.failed(&error))?;
    args.announce(&viewer.url(), &interrupt);
    while !interrupt.is_requested() {
        std::thread::sleep(POLL_INTERVAL);
    }
    Ok(interrupt.outcome())
}

impl Captured for Args {
    fn setup(&mut self) -> &mut Setup {
        &mut self.setup
    }

    fn launch(
        &self,
        tape: &Tape,
        interrupt: &Interrupt,
        build: impl FnOnce(Builder) -> Builder,
    ) -> Result<Launch<'_>, String> {
        Launch::played(
            &self.setup,
            &self.remote,
            self.scene.as_deref(),
            tape,
            interrupt,
            build,
        )
    }

    fn fill(&self, launch: &mut Launch<'_>, _: &Tape) -> Result<(), String> {
        launch.fill(self.kind.into());
        launch.serve(&self.remote, self.remote.asks_for_zmq())
    }

    fn begin(&self, sim: &mut Simulator) -> CommandLoop {
        sim.set_pace(self.speed);
        if !self.paused {
            sim.start();
        }
        CommandLoop::Live
    }
}

impl Args {
    fn listen(&self) -> Result<TcpListener, String> {
        let bound = TcpListener::bind((self.remote.address(), self.port));
        bound.map_err(|error| self.failed(&error))
    }

    fn failed(&self, error: &std::io::Error) -> String {
        format!("the viewer cannot start at port {}: {error}", self.port)
    }

    /// Prints the address, and opens the page.
    fn announce(&self, url: &str, interrupt: &Interrupt) {
        let progress = Progress::new(RunLimits::default(), true);
        self.setup.output(&progress, interrupt).viewing(url);
        self.open_browser(url);
    }

    fn open_browser(&self, url: &str) {
        if !self.no_open && !self.setup.json {
            open_browser(url);
        }
    }
}

/// Opens the page where there is a desktop. Without one, or when that fails, the address has been printed.
fn open_browser(url: &str) {
    let has_desktop = cfg!(target_os = "macos")
        || ["DISPLAY", "WAYLAND_DISPLAY"]
            .iter()
            .any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()));
    if !has_desktop {
        return;
    }
    let opener = if cfg!(target_os = "macos") {
        "open"
    } else {
        "xdg-open"
    };
    let opened = Command::new(opener)
        .arg(url)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    if let Ok(mut child) = opened {
        // Somebody has to wait for it, or it stays in the table of processes.
        drop(std::thread::spawn(move || drop(child.wait())));
    }
}

/// A pace beside the wall clock.
fn factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor == 0.0 || (0.001..=100.0).contains(&factor) => Ok(factor),
        _ => Err("0, or a number from 0.001 to 100 is needed".into()),
    }
}
