//! The options about programs outside, for `run` and `serve`.

use std::io::{Error, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, TcpListener};
use std::path::PathBuf;

use super::complain;
use super::interrupt::Interrupt;
use super::output::Output;
use super::permissions::{HEADING, PermissionArgs};
use super::setup::Setup;
use permissions::Permissions;
use simulator::{Limits, Options, Simulator};

/// Memory that Lua code may use where scripts may not do everything, MiB: a stranger's script does not exhaust the machine's either.
const FENCED_MEMORY: u32 = 4096;

/// Number of ports to try.
const TRIED_PORTS: u16 = 100;

/// A remote API and its port.
struct Api {
    name: &'static str,
    /// The port of the first instance; others use the next free one.
    first_port: u16,
    /// The parameter that chooses the port, as in CoppeliaSim.
    param: &'static str,
    /// The parameter that says whether there is a server at all, as in CoppeliaSim.
    start_param: &'static str,
}

const ZMQ: Api = Api {
    name: "ZeroMQ",
    first_port: 23_000,
    param: "zmqRemoteApi.rpcPort",
    start_param: "zmqRemoteApi.autoStart",
};
const WS: Api = Api {
    name: "WebSocket",
    first_port: 23_050,
    param: "wsRemoteApi.port",
    start_param: "wsRemoteApi.autoStart",
};
const STREAM: Api = Api {
    name: "Visualization stream",
    first_port: 23_020,
    param: "visualizationStream.ws.port",
    start_param: "visualizationStream.ws.enable",
};

/// Where programs with `simxStart` look for a simulator.
pub(super) const LEGACY_PORT: u16 = 19997;

impl Api {
    fn is_refused(&self, setup: &Setup) -> bool {
        matches!(setup.param(self.start_param), Some("false" | "0"))
    }
}

/// Remote API options
#[derive(clap::Args)]
pub(super) struct Remote {
    /// Serve the ZeroMQ remote API, optionally at PORT (0: any free port) [default: first free port from 23000]
    #[arg(long, value_name = "PORT", num_args = 0..=1, require_equals = true)]
    remote_api: Option<Option<u16>>,
    /// Serve the WebSocket remote API as well [default: first free port from 23050]
    #[arg(long, value_name = "PORT", num_args = 0..=1, require_equals = true)]
    ws_remote_api: Option<Option<u16>>,
    /// Serve the legacy remote API (simxStart) as well, at PORT; may be repeated: a port serves one program [default port: 19997]
    #[arg(long, value_name = "PORT", num_args = 0..=1, require_equals = true, default_missing_value = "19997")]
    legacy_remote_api: Vec<u16>,
    /// Serve CoppeliaSim's visualization stream for its web front end [default: first free port from 23020]
    #[arg(long, value_name = "PORT", num_args = 0..=1, require_equals = true)]
    visualization_stream: Option<Option<u16>>,
    /// Additional web origin that may use the WebSocket remote API (`*`: all); may be repeated
    #[arg(long, value_name = "ORIGIN")]
    allow_origin: Vec<String>,
    /// Address to listen on, for remote APIs and servers of scripts. Clients may do what scripts may; a non-local address implies --no-unsafe
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST), value_parser = ip_address)]
    bind: IpAddr,
    /// Allow scripts and clients everything, clients on other machines too
    #[arg(long = "unsafe", help_heading = HEADING, conflicts_with = "PermissionArgs")]
    allow_unsafe: bool,
    #[command(flatten)]
    permissions: PermissionArgs,
}

fn ip_address(text: &str) -> Result<IpAddr, String> {
    text.parse()
        .map_err(|_| "an IP address is needed, such as 127.0.0.1 or 0.0.0.0".to_owned())
}

/// The folder of the scene, and that of an installation of CoppeliaSim.
fn readable_folders(options: &Options) -> impl Iterator<Item = &PathBuf> {
    options.package_dirs.iter().chain(&options.resources)
}

impl Remote {
    /// Whether the ZeroMQ remote API is asked for.
    pub(super) fn asks_for_zmq(&self) -> bool {
        self.remote_api.is_some()
    }

    /// Where servers listen.
    pub(super) fn address(&self) -> IpAddr {
        self.bind
    }

    /// The options with what scripts may do, which depends on who can connect.
    pub(super) fn guard(&self, options: Options) -> Options {
        let is_open =
            !self.bind.is_loopback() && !self.allow_unsafe && !self.permissions.is_restricted();
        let permissions = if is_open {
            Permissions::strict()
        } else {
            self.permissions.permissions()
        };
        let is_fenced = is_open || self.permissions.is_restricted();
        Options {
            limits: options
                .limits
                .or_else(|| is_fenced.then(|| Limits::of_mebibytes(FENCED_MEMORY))),
            permissions: readable_folders(&options)
                .fold(permissions, |set, folder| set.of_scene(folder)),
            listen_address: self.bind,
            web_origins: self.allow_origin.clone(),
            ..options
        }
    }

    /// Starts the remote APIs unless disabled by parameters, and prints their addresses: ZeroMQ if `zmq`, the others on request.
    ///
    /// # Errors
    /// When a port is not free.
    pub(super) fn serve(
        &self,
        zmq: bool,
        setup: &Setup,
        sim: &mut Simulator,
        output: &Output,
        interrupt: &Interrupt,
    ) -> Result<(), String> {
        let at = |api: &Api, port| self.listener(setup, api, port);
        if zmq && !ZMQ.is_refused(setup) {
            let listen = || at(&ZMQ, self.remote_api.flatten());
            output.listening(ZMQ.name, sim.serve_zmq_by(listen, interrupt.flag())?);
        }
        if let Some(port) = self.ws_remote_api.filter(|_| !WS.is_refused(setup)) {
            output.listening(WS.name, sim.serve_ws_by(|| at(&WS, port))?);
        }
        for &port in &self.legacy_remote_api {
            let listen = || listener_at(self.bind, port);
            output.listening("Legacy", sim.serve_legacy_by(listen)?);
        }
        if let Some(port) = self
            .visualization_stream
            .filter(|_| !STREAM.is_refused(setup))
        {
            output.streaming(sim.serve_visualization_stream_by(|| at(&STREAM, port))?);
        }
        Ok(())
    }

    fn listener(&self, setup: &Setup, api: &Api, port: Option<u16>) -> Result<TcpListener, String> {
        let address = self.bind;
        let Api {
            first_port, param, ..
        } = api;
        let given = setup.param(param).map(|text| {
            text.parse()
                .map_err(|_| format!("{param}: no port: {text}"))
        });
        if let Some(port) = port.or(given.transpose()?) {
            return listener_at(address, port);
        }
        for port in *first_port..first_port + TRIED_PORTS {
            match TcpListener::bind((address, port)) {
                Ok(listener) => {
                    warn_of_next_port(api, port);
                    return Ok(listener);
                }
                Err(error) if error.kind() == ErrorKind::AddrInUse => {}
                Err(error) => return Err(cannot_listen(address, port, &error)),
            }
        }
        Err(format!(
            "ports {first_port} to {} are all in use at {address}",
            first_port + TRIED_PORTS - 1
        ))
    }
}

/// Programs that give no port look at the first one, and find another program there.
fn warn_of_next_port(api: &Api, port: u16) {
    let Api {
        name, first_port, ..
    } = api;
    if port != *first_port {
        complain(&format!(
            "port {first_port} is in use: clients of the {name} API that give no port reach another program. This one listens at port {port}"
        ));
    }
}

fn listener_at(address: IpAddr, port: u16) -> Result<TcpListener, String> {
    TcpListener::bind((address, port)).map_err(|error| cannot_listen(address, port, &error))
}

fn cannot_listen(address: IpAddr, port: u16, error: &Error) -> String {
    if error.kind() == ErrorKind::AddrNotAvailable {
        return format!(
            "cannot listen at {address}: it is not an address of this machine. --bind 127.0.0.1 serves programs on this machine, --bind \
             0.0.0.0 those on others too"
        );
    }
    format!("cannot listen at {address}:{port}: {error}")
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        remote: Remote,
    }

    fn guarded(words: &[&str], limits: Option<Limits>) -> Option<Limits> {
        let line = Line::parse_from([&["swanilda"], words].concat());
        let options = Options {
            limits,
            ..Options::default()
        };
        line.remote.guard(options).limits
    }

    #[test]
    fn memory_is_limited_where_scripts_may_not_do_everything() {
        let fenced = Some(Limits { memory: 4 << 30 });
        assert_eq!(guarded(&[], None), None);
        assert_eq!(guarded(&["--no-unsafe"], None), fenced);
        assert_eq!(guarded(&["--allow-run"], None), fenced);
        assert_eq!(guarded(&["--bind", "0.0.0.0"], None), fenced);
        assert_eq!(guarded(&["--bind", "0.0.0.0", "--unsafe"], None), None);
    }

    #[test]
    fn a_limit_of_the_command_line_goes_first() {
        let asked = Some(Limits::of_mebibytes(64));
        assert_eq!(guarded(&["--no-unsafe"], asked), asked);
        assert_eq!(guarded(&[], asked), asked);
    }
}
