//! `swanilda mcp`: a server of the Model Context Protocol, for language models.

use std::io::{Write, stdin, stdout};
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Duration;

use ::mcp::{HttpServer, Running, Secret};
use agents::{Agent, Setting};
use io::signals::reserve_standard_output;
use permissions::Permissions;
use simulator::{Limits, Options, Simulator};

use super::interrupt::Interrupt;
use super::permissions::{HEADING, PermissionArgs};
use super::resources::ResourceArgs;
use super::setup::step_length;
use super::{Outcome, complain};

/// Memory that Lua code may use, MiB: a stranger's script does not exhaust the machine's.
const MEMORY: u32 = 4096;

/// Serve the Model Context Protocol, for language models
///
/// Scripts and tools may read the scene's folder and nothing else, unless options allow more.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene: a Lua file, a CoppeliaSim file, a robot, or a folder made by unpack [default: the default scene]
    scene: Option<PathBuf>,
    /// Serve by HTTP at PORT of 127.0.0.1 (0: any free port) instead of standard input and output
    #[arg(long, value_name = "PORT")]
    http: Option<u16>,
    /// Secret of clients by HTTP, 16 characters or more [default: a random one, which is printed]
    #[arg(
        long,
        value_name = "SECRET",
        env = "SWANILDA_MCP_SECRET",
        hide_env_values = true,
        requires = "http"
    )]
    secret: Option<String>,
    /// Start with an empty scene instead of the default scene
    #[arg(long)]
    empty: bool,
    /// Length of a simulation step
    #[arg(long, value_name = "SECONDS", value_parser = step_length, allow_negative_numbers = true)]
    dt: Option<f64>,
    /// Longest time that a call of a tool may take by the wall clock
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = clap::value_parser!(u64).range(1..=86_400))]
    call_timeout: u64,
    /// Memory limit for the Lua code, MiB
    #[arg(long, value_name = "MIB", default_value_t = MEMORY, value_parser = clap::value_parser!(u32).range(1..))]
    memory: u32,
    #[command(flatten)]
    resources: ResourceArgs,
    /// Allow scripts and tools everything
    #[arg(long = "unsafe", help_heading = HEADING, conflicts_with = "PermissionArgs")]
    allow_unsafe: bool,
    #[command(flatten)]
    permissions: PermissionArgs,
}

/// Permissions are restricted here, without being asked.
pub(super) fn under_own_heading(argument: clap::Arg) -> clap::Arg {
    if argument.get_help_heading() == Some(HEADING) {
        argument
            .help_heading("Permissions of scripts and tools (default: reading the scene's folder)")
    } else {
        argument
    }
}

/// Serves until the client goes, or until ctrl-c and SIGTERM.
pub(super) fn serve(args: &Args) -> Outcome {
    // What native code writes to standard output must not come between the messages.
    let reserved = reserve_standard_output();
    let interrupt = Interrupt::of_scripts_here();
    let setting = args.setting();
    let running = Running::new(setting.options.stop.clone());
    let mut agent =
        Agent::new(setting, args.scene.as_deref()).map_err(|error| error.to_string())?;
    if let Some(dt) = args.dt {
        agent.set_step(dt);
    }
    match args.http {
        Some(port) => args.serve_http(port, &mut agent, &running, &interrupt)?,
        None => {
            end_with(&interrupt);
            let mut output: Box<dyn Write + Send> = match reserved {
                Some(file) => Box::new(file),
                None => Box::new(stdout()),
            };
            // A client that is gone has ended it.
            let _ = ::mcp::serve(&mut agent, stdin(), &mut output, &running);
        }
    }
    Ok(interrupt.outcome())
}

/// A read of standard input cannot be ended, so the program ends in the middle of it.
fn end_with(interrupt: &Interrupt) {
    const POLL_INTERVAL: Duration = Duration::from_millis(50);
    let interrupt = interrupt.clone();
    let watch = move || {
        while !interrupt.flag().load(Ordering::Relaxed) {
            std::thread::sleep(POLL_INTERVAL);
        }
        std::process::exit(i32::from(interrupt.exit_code()));
    };
    // Without a thread for it, the second request ends the program.
    let _ = std::thread::Builder::new().name("end".into()).spawn(watch);
}

impl Args {
    fn setting(&self) -> Setting {
        let mut options = Options {
            limits: Some(Limits::of_mebibytes(self.memory)),
            resources: self.resources.folder(),
            ..Options::default()
        };
        let folders = self.scene.as_deref().map(Simulator::folder_of_scene);
        let folders = folders.iter().chain(&options.resources);
        options.permissions = folders.fold(self.allowed(), |set, folder| set.of_scene(folder));
        Setting {
            options,
            time_limit: Duration::from_secs(self.call_timeout),
            is_empty: self.empty,
        }
    }

    fn allowed(&self) -> Permissions {
        if self.allow_unsafe {
            Permissions::all()
        } else if self.permissions.is_restricted() {
            self.permissions.permissions()
        } else {
            Permissions::strict()
        }
    }

    fn serve_http(
        &self,
        port: u16,
        agent: &mut Agent,
        running: &Running,
        interrupt: &Interrupt,
    ) -> Result<(), String> {
        let secret = match &self.secret {
            Some(text) => {
                Secret::given(text).ok_or("a secret has 16 characters or more, without spaces")?
            }
            None => Secret::random().map_err(|error| error.to_string())?,
        };
        let shown = if self.secret.is_some() {
            "(the given secret)"
        } else {
            secret.text()
        };
        let shown = shown.to_owned();
        let server = HttpServer::bind(port, secret)
            .map_err(|error| format!("cannot listen at 127.0.0.1:{port}: {error}"))?;
        let address = server.address().map_err(|error| error.to_string())?;
        complain(&format!(
            "MCP at http://{address}/mcp\nAuthorization: Bearer {shown}"
        ));
        server
            .serve(agent, running, || interrupt.is_requested())
            .map_err(|error| error.to_string())
    }
}
