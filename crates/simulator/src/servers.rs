//! Servers of a simulator: the remote APIs and the stream of events.

use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use ::scene::object::script_object::ScriptType;
use io::ZmqServer;
use script::{Detached, Sim};

use super::Simulator;

/// The add-on that serves clients by ZeroMQ.
const ZMQ_ADD_ON: &[u8] = b"sim = require 'sim' require 'remote.zmq'";
/// The add-on that serves clients by WebSocket.
const WS_ADD_ON: &[u8] = b"sim = require 'sim' require 'remote.ws'";

/// The add-on that streams events to CoppeliaSim's web front end.
const VISUALIZATION_ADD_ON: &[u8] = b"sim = require 'sim' require 'remote.visualization'";

impl Simulator {
    /// Lets the clients that connect to `listener` by ZeroMQ call functions: the remote API. Returns the address it listens at.
    /// A client may make a loop iteration last as long as it likes; set `stop` to end such an iteration.
    ///
    /// # Errors
    /// When the server cannot start.
    pub fn serve_zmq(
        &mut self,
        listener: TcpListener,
        stop: Arc<AtomicBool>,
    ) -> std::io::Result<SocketAddr> {
        self.serve_zmq_by(|| Ok(listener), stop)
            .map_err(std::io::Error::other)
    }

    /// The same at a listener that `listen` opens; a replay opens none.
    ///
    /// # Errors
    /// Those of `listen`, and when the server cannot start.
    pub fn serve_zmq_by(
        &mut self,
        listen: impl FnOnce() -> Result<TcpListener, String>,
        stop: Arc<AtomicBool>,
    ) -> Result<SocketAddr, String> {
        let address = self.listen("the ZeroMQ remote API", listen, |sim, listener| {
            let server = ZmqServer::start(sim.event_loop.get()?, listener, stop)?;
            modules_messaging::remote::set_zmq_server(&sim.modules.states, server);
            Ok(())
        })?;
        self.name_port("zmqRemoteApi.rpcPort", address);
        self.start_server("ZMQ remote API server@addOnScript", ZMQ_ADD_ON);
        Ok(address)
    }

    /// The same for clients that connect by WebSocket.
    ///
    /// # Errors
    /// When the listener cannot be used.
    pub fn serve_ws(&mut self, listener: TcpListener) -> std::io::Result<SocketAddr> {
        self.serve_ws_by(|| Ok(listener))
            .map_err(std::io::Error::other)
    }

    /// The same at a listener that `listen` opens; a replay opens none.
    ///
    /// # Errors
    /// Those of `listen`, and when the listener cannot be used.
    pub fn serve_ws_by(
        &mut self,
        listen: impl FnOnce() -> Result<TcpListener, String>,
    ) -> Result<SocketAddr, String> {
        let address = self.listen("the WebSocket remote API", listen, |sim, listener| {
            modules_messaging::remote::set_web_socket_listener(&sim.modules.states, listener);
            Ok(())
        })?;
        self.name_port("wsRemoteApi.port", address);
        self.start_server("WebSocket remote API server@addOnScript", WS_ADD_ON);
        Ok(address)
    }

    /// Serves programs with `simxStart`, one at a time: the legacy remote API. Clients may use the synchronous mode.
    ///
    /// # Errors
    /// When the listener cannot be used.
    pub fn serve_legacy(&mut self, listener: TcpListener) -> std::io::Result<SocketAddr> {
        self.serve_legacy_by(|| Ok(listener))
            .map_err(std::io::Error::other)
    }

    /// The same at a listener that `listen` opens; a replay opens none.
    ///
    /// # Errors
    /// Those of `listen`, and when the listener cannot be used.
    pub fn serve_legacy_by(
        &mut self,
        listen: impl FnOnce() -> Result<TcpListener, String>,
    ) -> Result<SocketAddr, String> {
        self.copied(|sim| {
            let event_loop = sim.event_loop.get().map_err(|error| error.to_string())?;
            let age = Duration::from_secs_f64(sim.clock.wall_seconds());
            let states = &sim.modules.states;
            modules_messaging::sim_remote_api::serve(states, &event_loop, self.tape(), listen, age)
        })
    }

    /// Streams events (protocol 3) to those that connect by WebSocket, as CoppeliaSim's add-on "Visualization stream" does.
    ///
    /// # Errors
    /// When the listener cannot be used.
    pub fn serve_visualization_stream(
        &mut self,
        listener: TcpListener,
    ) -> std::io::Result<SocketAddr> {
        self.serve_visualization_stream_by(|| Ok(listener))
            .map_err(std::io::Error::other)
    }

    /// The same at a listener that `listen` opens; a replay opens none.
    ///
    /// # Errors
    /// Those of `listen`, and when the listener cannot be used.
    pub fn serve_visualization_stream_by(
        &mut self,
        listen: impl FnOnce() -> Result<TcpListener, String>,
    ) -> Result<SocketAddr, String> {
        let address = self.listen("the visualization stream", listen, |sim, listener| {
            let states = &sim.modules.states;
            modules_messaging::remote::set_visualization_listener(states, listener);
            Ok(())
        })?;
        self.name_port("visualizationStream.ws.port", address);
        self.start_server("Visualization stream@addOnScript", VISUALIZATION_ADD_ON);
        Ok(address)
    }

    /// Where a server listens, which `serve` starts; a replay knows it from the capture.
    fn listen(
        &self,
        what: &str,
        listen: impl FnOnce() -> Result<TcpListener, String>,
        serve: impl FnOnce(&Sim, TcpListener) -> std::io::Result<()>,
    ) -> Result<SocketAddr, String> {
        let address = self.tape().input(&format!("the address of {what}"), || {
            let listener = listen()?;
            let address = listener.local_addr();
            let started = || serve(&self.inside(), listener);
            let address = address.and_then(|address| started().map(|()| address));
            let failed = |error| format!("the remote API cannot start: {error}");
            address.map_err(failed).map(|address| address.to_string())
        });
        let address = address.map_err(|lost| lost.to_string())??;
        address
            .parse()
            .map_err(|_| format!("'{address}' is no address"))
    }

    /// Waits until a socket has received something, at most `timeout`, and says whether it waited; without sockets it returns false at once.
    pub fn wait_for_request(&self, timeout: Duration) -> bool {
        let sim = self.inside();
        sim.event_loop.wait_for_input(timeout)
    }

    /// Whether scripts have ZeroMQ sockets, whose messages `wait_for_request` does not notice.
    pub fn has_zmq_sockets(&self) -> bool {
        let sim = self.inside();
        modules_messaging::sim_zmq::has_sockets(&sim.modules.states)
    }

    /// Tells scripts the port of a server, as a named parameter.
    fn name_port(&self, parameter: &str, address: SocketAddr) {
        let sim = self.inside();
        sim.app.borrow_mut().named_params.insert(
            parameter.to_owned(),
            address.port().to_string().into_bytes(),
        );
    }

    /// Starts the add-on that answers the clients of a server.
    fn start_server(&self, name: &str, code: &[u8]) {
        let detached = Detached::of_text(name, code);
        let sim = self.inside();
        let add_on = sim.scripts.add_detached(ScriptType::AddOn, detached);
        sim.start_detached(&add_on);
    }
}
