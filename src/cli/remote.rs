//! The options about programs outside, for `run` and `serve`.

use std::net::{IpAddr, Ipv4Addr, TcpListener};

use super::interrupt::Interrupt;
use super::output::Output;
use super::setup::Setup;
use crate::{Options, Simulator};

/// The port of the first instance; others take the next free one.
const FIRST_PORT: u16 = 23_000;
/// How many ports are tried.
const TRIED_PORTS: u16 = 100;
/// The parameter that chooses the port, as in CoppeliaSim.
const PORT_PARAM: &str = "zmqRemoteApi.rpcPort";
/// The parameter that says whether there is a server at all, as in CoppeliaSim.
const START_PARAM: &str = "zmqRemoteApi.autoStart";

/// Which programs outside may drive the simulator
#[derive(clap::Args)]
pub(super) struct Remote {
    /// Serve the ZeroMQ remote API, at a port of one's choice (0: any) [default port: the first free one from 23000]
    #[arg(long, value_name = "PORT", num_args = 0..=1, require_equals = true)]
    remote_api: Option<Option<u16>>,
    /// Address to listen at, for remote APIs and servers of scripts; who connects there can do whatever a script can. Another than this machine's own implies --no-unsafe
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    bind: IpAddr,
    /// Nobody starts programs or loads native libraries, and remote clients get no files
    #[arg(long)]
    no_unsafe: bool,
    /// Trust those who connect from other machines: they may start programs and use files
    #[arg(long = "unsafe", conflicts_with = "no_unsafe")]
    allow_unsafe: bool,
}

impl Remote {
    pub(super) fn is_asked_for(&self) -> bool {
        self.remote_api.is_some()
    }

    /// The options as those who can connect make necessary.
    pub(super) fn guard(&self, options: Options) -> Options {
        let allowed = !self.no_unsafe && (self.bind.is_loopback() || self.allow_unsafe);
        Options { exec_unsafe: allowed, exec_unsafe_ext: allowed, listen_address: self.bind, ..options }
    }

    /// Serves the ZeroMQ remote API, unless a parameter says not to, and tells where.
    ///
    /// # Errors
    /// When the port is not free.
    pub(super) fn serve(
        &self,
        setup: &Setup,
        sim: &mut Simulator,
        output: &Output,
        interrupt: &Interrupt,
    ) -> Result<(), String> {
        if matches!(setup.param(START_PARAM), Some("false" | "0")) {
            return Ok(());
        }
        let listener = self.listener(setup)?;
        let address = sim
            .serve_zmq(listener, interrupt.flag())
            .map_err(|error| format!("the remote API cannot start: {error}"))?;
        output.listening("ZeroMQ", address);
        Ok(())
    }

    fn listener(&self, setup: &Setup) -> Result<TcpListener, String> {
        let address = self.bind;
        let param =
            setup.param(PORT_PARAM).map(|text| text.parse().map_err(|_| format!("{PORT_PARAM}: no port: {text}")));
        if let Some(port) = self.remote_api.flatten().or(param.transpose()?) {
            let refused = |error| format!("cannot listen at {address}:{port}: {error}");
            return TcpListener::bind((address, port)).map_err(refused);
        }
        let mut listeners = (FIRST_PORT..FIRST_PORT + TRIED_PORTS).map(|port| TcpListener::bind((address, port)));
        let free = listeners.find_map(Result::ok);
        free.ok_or_else(|| format!("no port from {FIRST_PORT} on is free at {address}"))
    }
}
