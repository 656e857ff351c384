//! Services: those that a node offers, and calls of those of others.

use std::net::{Shutdown, TcpStream};
use std::sync::mpsc::{self, Receiver, Sender, SyncSender, TryRecvError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use crate::clock::Deadline;
use crate::network::Place;
use crate::node::Shared;
use crate::tcpros::{Connection, Head, field, read_frame, read_head, write_frame, write_head};
use crate::{Error, Result, limits};

/// The type of a service, as both sides compare it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceType {
    /// `std_srvs/SetBool`.
    pub name: String,
    /// 32 hexadecimal digits.
    pub md5: String,
}

/// A service that this node offers.
pub struct ServiceServer {
    service: Arc<Service>,
    requests: Receiver<Request>,
    node: Arc<Shared>,
}

/// What its connections share.
pub(crate) struct Service {
    pub(crate) name: String,
    service_type: ServiceType,
    requests: SyncSender<Request>,
}

/// What somebody asks a service.
pub struct Request {
    /// The message.
    pub bytes: Vec<u8>,
    answer: Sender<std::result::Result<Vec<u8>, String>>,
}

impl Request {
    /// Answers it: with a message, or with the reason why there is none.
    pub fn answer(self, answer: std::result::Result<Vec<u8>, String>) {
        // If the caller has closed the connection, there is nobody to answer.
        let _ = self.answer.send(answer);
    }
}

impl ServiceServer {
    pub(crate) fn new(node: &Arc<Shared>, name: String, service_type: ServiceType) -> Self {
        let (sender, requests) = mpsc::sync_channel(limits::REQUESTS);
        let service = Arc::new(Service {
            name,
            service_type,
            requests: sender,
        });
        Self {
            service,
            requests,
            node: node.clone(),
        }
    }

    pub(crate) fn service(&self) -> &Arc<Service> {
        &self.service
    }

    /// The oldest request that waits.
    #[must_use]
    pub fn take(&self) -> Option<Request> {
        self.requests.try_recv().ok()
    }
}

impl Drop for ServiceServer {
    fn drop(&mut self) {
        self.node.forget_service(&self.service.name);
    }
}

impl Service {
    /// Answers requests until the connection or the service ends.
    pub(crate) fn serve(&self, mut stream: Connection, head: &Head, caller: &str) -> Result<()> {
        let (md5, own) = (field(head, "md5sum"), &self.service_type);
        if !(md5.is_empty() || md5 == "*" || md5 == own.md5) {
            let problem = format!(
                "service {} has type {} ({}), not {md5}",
                self.name, own.name, own.md5
            );
            return write_head(&mut stream, &[("error", &problem)]);
        }
        let (request, response) = (
            format!("{}Request", own.name),
            format!("{}Response", own.name),
        );
        let fields = [
            ("callerid", caller),
            ("type", &own.name),
            ("md5sum", &own.md5),
            ("request_type", &request),
            ("response_type", &response),
        ];
        write_head(&mut stream, &fields)?;
        stream.set_read_timeout(None)?;
        while let Some(bytes) = read_frame(&mut stream, limits::MESSAGE)? {
            let (ok, answer) = match self.ask(bytes) {
                Ok(answer) => (1, answer),
                Err(reason) => (0, reason.into_bytes()),
            };
            std::io::Write::write_all(&mut stream, &[ok])?;
            write_frame(&mut stream, &answer)?;
        }
        Ok(())
    }

    /// Waits for the answer of the service's owner.
    fn ask(&self, bytes: Vec<u8>) -> std::result::Result<Vec<u8>, String> {
        let (answer, answered) = mpsc::channel();
        self.requests
            .try_send(Request { bytes, answer })
            .map_err(|_| "the service has too much to do".to_string())?;
        answered
            .recv()
            .map_err(|_| "the service has ended".to_string())?
    }
}

/// A call that is under way. It ends when this is dropped.
pub struct ServiceCall {
    answer: Receiver<Result<Vec<u8>>>,
    stream: Arc<Mutex<Option<TcpStream>>>,
}

impl ServiceCall {
    /// Asks the service at the place that the master has said.
    pub(crate) fn start(
        node: &Arc<Shared>,
        name: &str,
        service_type: &ServiceType,
        request: Vec<u8>,
    ) -> Result<Self> {
        let (sender, answer) = mpsc::channel();
        let stream = Arc::new(Mutex::new(None));
        let (theirs, node, name, service_type) = (
            stream.clone(),
            node.clone(),
            name.to_string(),
            service_type.clone(),
        );
        thread::Builder::new()
            .name(format!("ROS {name}"))
            .spawn(move || {
                let answer = perform(&node, &name, &service_type, &request, &theirs);
                // If the caller has closed the connection, there is nobody to answer.
                let _ = sender.send(answer);
            })?;
        Ok(Self { answer, stream })
    }

    /// The answer, once it is there.
    #[must_use]
    pub fn poll(&self) -> Option<Result<Vec<u8>>> {
        match self.answer.try_recv() {
            Ok(answer) => Some(answer),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(Error::protocol("the call has ended"))),
        }
    }
}

impl Drop for ServiceCall {
    fn drop(&mut self) {
        if let Some(stream) = self
            .stream
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take()
        {
            // Shutting down fails only if the connection is closed already.
            let _ = stream.shutdown(Shutdown::Both);
        }
    }
}

fn perform(
    node: &Shared,
    name: &str,
    service_type: &ServiceType,
    request: &[u8],
    shared: &Mutex<Option<TcpStream>>,
) -> Result<Vec<u8>> {
    let uri = match node.master.call("lookupService", &[name]) {
        Err(Error::Refused { .. }) => return Err(Error::NoService(name.to_string())),
        other => other?,
    };
    let place = Place::parse(uri.as_text().unwrap_or_default(), "rosrpc")?;
    let mut stream = node
        .network
        .connect(&place, Deadline::after(limits::TIMEOUT))?;
    *shared.lock().unwrap_or_else(PoisonError::into_inner) = Some(stream.try_clone()?);
    stream.set_read_timeout(Some(limits::TIMEOUT))?;
    let caller = node.master.caller.as_str();
    let fields = [
        ("callerid", caller),
        ("service", name),
        ("md5sum", &service_type.md5),
        ("type", &service_type.name),
    ];
    write_head(&mut stream, &fields)?;
    let head = read_head(&mut stream)?;
    if let Some(problem) = head.get("error") {
        return Err(Error::Peer(problem.clone()));
    }
    write_frame(&mut stream, request)?;
    // No read timeout from here on: the caller decides how long to wait for the service.
    stream.set_read_timeout(None)?;
    let mut ok = [0];
    std::io::Read::read_exact(&mut stream, &mut ok)?;
    let answer = read_frame(&mut stream, limits::MESSAGE)?
        .ok_or_else(|| Error::protocol("half an answer"))?;
    if ok == [1] {
        Ok(answer)
    } else {
        Err(Error::Peer(String::from_utf8_lossy(&answer).into_owned()))
    }
}
