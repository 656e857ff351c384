//! Topics that a node reads: a connection and a thread for each publisher.

use std::collections::BTreeMap;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use crate::clock::Deadline;
use crate::inbox::Inbox;
use crate::master::value_of;
use crate::network::{NodeNetwork, Place};
use crate::node::Shared;
use crate::tcpros::{field, read_frame, read_head, write_head};
use crate::xmlrpc::{call_text, read_response};
use crate::{Error, MessageType, Result, XmlRpcValue, http, limits};

/// Reads messages of a topic.
pub struct Subscriber {
    pub(crate) subscription: Arc<Subscription>,
    node: Arc<Shared>,
}

/// What its threads share.
pub(crate) struct Subscription {
    pub(crate) topic: String,
    pub(crate) message_type: MessageType,
    caller: String,
    network: NodeNetwork,
    inbox: Inbox<Vec<u8>>,
    links: Mutex<BTreeMap<String, Arc<Link>>>,
}

/// A connection to a publisher, which is made again and again until it is ended.
#[derive(Default)]
struct Link {
    state: Mutex<LinkState>,
    ended: Condvar,
}

#[derive(Default)]
struct LinkState {
    has_ended: bool,
    stream: Option<TcpStream>,
}

impl Subscriber {
    pub(crate) fn new(
        node: &Arc<Shared>,
        topic: String,
        message_type: MessageType,
        queue_size: usize,
    ) -> Self {
        let subscription = Subscription {
            topic,
            message_type,
            caller: node.master.caller.clone(),
            network: node.network,
            inbox: Inbox::new(queue_size),
            links: Mutex::default(),
        };
        Self {
            subscription: Arc::new(subscription),
            node: node.clone(),
        }
    }

    /// The oldest message that waits.
    #[must_use]
    pub fn take(&self) -> Option<Vec<u8>> {
        self.subscription.inbox.take()
    }

    /// How many messages wait.
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.subscription.inbox.len()
    }

    /// Why a publisher is not read, if that is news.
    #[must_use]
    pub fn problem(&self) -> Option<String> {
        self.subscription.inbox.take_problem()
    }

    /// The topic, as all nodes know it.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.subscription.topic
    }
}

impl Drop for Subscriber {
    fn drop(&mut self) {
        self.subscription.inbox.close();
        self.subscription.update(&[]);
        self.node.forget_subscription(&self.subscription);
    }
}

impl Subscription {
    fn links(&self) -> MutexGuard<'_, BTreeMap<String, Arc<Link>>> {
        self.links.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The publishers there are now, by the addresses of their nodes.
    pub(crate) fn update(self: &Arc<Self>, publishers: &[String]) {
        let mut links = self.links();
        links.retain(|uri, link| {
            let stays = publishers.contains(uri);
            if !stays {
                link.end();
            }
            stays
        });
        for uri in publishers.iter().take(limits::PUBLISHERS) {
            if !links.contains_key(uri) {
                let link = Arc::new(Link::default());
                let (subscription, theirs, place) = (self.clone(), link.clone(), uri.clone());
                let started = thread::Builder::new()
                    .name(format!("ROS {}", self.topic))
                    .spawn(move || subscription.read_from(&place, &theirs));
                if started.is_ok() {
                    links.insert(uri.clone(), link);
                }
            }
        }
    }

    /// The addresses of the publishers' nodes.
    pub(crate) fn publishers(&self) -> Vec<String> {
        self.links().keys().cloned().collect()
    }

    fn read_from(&self, uri: &str, link: &Link) {
        let [mut delay, longest] = limits::RETRY_DELAY;
        loop {
            let was_connected = match self.read_once(uri, link) {
                Ok(()) => true,
                Err(Error::Io(_)) => false,
                Err(error) => {
                    self.inbox
                        .note_problem(format!("publisher {uri} of {}: {error}", self.topic));
                    false
                }
            };
            delay = if was_connected {
                limits::RETRY_DELAY[0]
            } else {
                (delay * 2).min(longest)
            };
            if link.wait(delay) {
                return;
            }
        }
    }

    /// Connects and reads until the connection ends.
    fn read_once(&self, uri: &str, link: &Link) -> Result<()> {
        let place = self.request(uri)?;
        let mut stream = self
            .network
            .connect(&place, Deadline::after(limits::TIMEOUT))?;
        link.set_stream(&stream)?;
        stream.set_read_timeout(Some(limits::TIMEOUT))?;
        let own = &self.message_type;
        let fields = [
            ("callerid", self.caller.as_str()),
            ("topic", &self.topic),
            ("type", &own.name),
            ("md5sum", &own.md5),
            ("message_definition", &own.definition),
            ("tcp_nodelay", "1"),
        ];
        write_head(&mut stream, &fields)?;
        let head = read_head(&mut stream)?;
        if let Some(problem) = head.get("error") {
            return Err(Error::Peer(problem.clone()));
        }
        let md5 = field(&head, "md5sum");
        if md5 != own.md5 && own.md5 != "*" {
            return Err(Error::Peer(format!(
                "it has type {} ({md5}), not {} ({})",
                field(&head, "type"),
                own.name,
                own.md5
            )));
        }
        // No read timeout from here on: topics may be published rarely.
        stream.set_read_timeout(None)?;
        while let Ok(Some(message)) = read_frame(&mut stream, limits::MESSAGE) {
            self.inbox.push(message);
        }
        Ok(())
    }

    /// Asks the publisher's node where the topic is served.
    fn request(&self, uri: &str) -> Result<Place> {
        let protocols =
            XmlRpcValue::Array(vec![XmlRpcValue::Array(vec![XmlRpcValue::text("TCPROS")])]);
        let arguments = [
            XmlRpcValue::text(&self.caller),
            XmlRpcValue::text(&self.topic),
            protocols,
        ];
        let node = Place::parse(uri, "http")?;
        let answer = http::post(
            self.network,
            &node,
            &call_text("requestTopic", &arguments),
            limits::TIMEOUT,
        )?;
        let value = value_of(read_response(&answer)?).map_err(Error::Peer)?;
        match value.as_array() {
            Some(
                [
                    XmlRpcValue::String(protocol),
                    XmlRpcValue::String(host),
                    XmlRpcValue::Int(port),
                ],
            ) if protocol == "TCPROS" => Place::parse(&format!("rosrpc://{host}:{port}"), "rosrpc"),
            _ => Err(Error::protocol("no address of the topic")),
        }
    }
}

impl Link {
    fn state(&self) -> MutexGuard<'_, LinkState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn end(&self) {
        let mut state = self.state();
        state.has_ended = true;
        if let Some(stream) = state.stream.take() {
            // Shutting down fails only if the connection is closed already.
            let _ = stream.shutdown(Shutdown::Both);
        }
        self.ended.notify_all();
    }

    /// What is closed when the link ends.
    fn set_stream(&self, stream: &TcpStream) -> Result<()> {
        let mut state = self.state();
        if state.has_ended {
            return Err(Error::Io(std::io::ErrorKind::ConnectionAborted.into()));
        }
        state.stream = Some(stream.try_clone()?);
        Ok(())
    }

    /// Whether it has ended, after that time at the latest.
    fn wait(&self, timeout: Duration) -> bool {
        let waited = self
            .ended
            .wait_timeout_while(self.state(), timeout, |state| !state.has_ended);
        waited.unwrap_or_else(PoisonError::into_inner).0.has_ended
    }
}
