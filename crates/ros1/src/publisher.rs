//! Topics that a node publishes.

use std::io::ErrorKind;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::inbox::{Arrival, Inbox};
use crate::node::Shared;
use crate::tcpros::{Connection, Head, field, write_frame, write_head};
use crate::{MessageType, Result, limits};

/// How often a connection on which nothing is sent is looked at.
const POLL_INTERVAL: Duration = Duration::from_secs(1);

/// Publishes messages of a topic. The topic ends with the last of its publishers.
pub struct Publisher {
    topic: Arc<Topic>,
}

/// A topic of the node, whoever publishes it.
pub(crate) struct Topic {
    pub(crate) name: String,
    pub(crate) message_type: MessageType,
    node: Arc<Shared>,
    state: Mutex<State>,
}

struct State {
    queue_size: usize,
    is_latched: bool,
    last: Option<Message>,
    subscribers: Vec<Subscriber>,
}

type Message = Arc<[u8]>;

/// A connection of a subscriber.
struct Subscriber {
    queue: Arc<Inbox<Message>>,
    stream: TcpStream,
    caller: String,
}

impl Publisher {
    pub(crate) fn new(topic: Arc<Topic>) -> Self {
        Self { topic }
    }

    /// Sends a message to all who subscribe. It waits for none of them.
    pub fn publish(&self, message: Vec<u8>) {
        let message: Message = message.into();
        let mut state = self.topic.state();
        state
            .subscribers
            .iter()
            .for_each(|subscriber| subscriber.queue.push(message.clone()));
        if state.is_latched {
            state.last = Some(message);
        }
    }

    /// The topic, as all nodes know it.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.topic.name
    }

    /// How many connections of subscribers there are.
    #[must_use]
    pub fn subscribers(&self) -> usize {
        self.topic.state().subscribers.len()
    }
}

impl Topic {
    pub(crate) fn new(name: String, message_type: MessageType, node: Arc<Shared>) -> Self {
        let state = State {
            queue_size: 1,
            is_latched: false,
            last: None,
            subscribers: Vec::new(),
        };
        Self {
            name,
            message_type,
            node,
            state: Mutex::new(state),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Another publisher of it.
    pub(crate) fn widen(&self, queue_size: usize, is_latched: bool) {
        let mut state = self.state();
        let all = if queue_size == 0 {
            limits::QUEUE
        } else {
            queue_size
        };
        state.queue_size = state.queue_size.max(all);
        state.is_latched |= is_latched;
        state
            .subscribers
            .iter()
            .for_each(|subscriber| subscriber.queue.widen(all));
    }

    /// The names of those that are connected.
    pub(crate) fn callers(&self) -> Vec<String> {
        self.state()
            .subscribers
            .iter()
            .map(|subscriber| subscriber.caller.clone())
            .collect()
    }

    /// Why a subscriber does not fit, if it does not.
    fn problem(&self, head: &Head) -> Option<String> {
        let (md5, name) = (field(head, "md5sum"), field(head, "type"));
        let own = &self.message_type;
        let fits = md5.is_empty() || md5 == "*" || md5 == own.md5;
        (!fits).then(|| {
            format!(
                "topic {} has type {} ({}), not {name} ({md5})",
                self.name, own.name, own.md5
            )
        })
    }

    /// Sends messages until the connection or the topic ends.
    pub(crate) fn serve(
        self: Arc<Self>,
        mut stream: Connection,
        head: &Head,
        caller: &str,
    ) -> Result<()> {
        if let Some(problem) = self.problem(head) {
            return write_head(&mut stream, &[("error", &problem)]);
        }
        let latching = if self.state().is_latched { "1" } else { "0" };
        let own = &self.message_type;
        let fields = [
            ("callerid", caller),
            ("topic", &self.name),
            ("type", &own.name),
            ("md5sum", &own.md5),
            ("message_definition", &own.definition),
            ("latching", latching),
        ];
        write_head(&mut stream, &fields)?;
        let queue = self.connect(&stream, field(head, "callerid"))?;
        // The topic ends with its publishers, not with its connections.
        let topic = Arc::downgrade(&self);
        drop(self);
        let sent = send(&mut stream, &queue);
        if let Some(topic) = topic.upgrade() {
            topic
                .state()
                .subscribers
                .retain(|subscriber| !Arc::ptr_eq(&subscriber.queue, &queue));
        }
        sent
    }

    fn connect(&self, stream: &TcpStream, caller: &str) -> Result<Arc<Inbox<Message>>> {
        let mut state = self.state();
        let queue = Arc::new(Inbox::new(state.queue_size));
        if let Some(last) = &state.last {
            queue.push(last.clone());
        }
        let subscriber = Subscriber {
            queue: queue.clone(),
            stream: stream.try_clone()?,
            caller: caller.to_string(),
        };
        state.subscribers.push(subscriber);
        Ok(queue)
    }
}

fn send(stream: &mut TcpStream, queue: &Inbox<Message>) -> Result<()> {
    // This only detects the end of the connection: a subscriber sends nothing.
    stream.set_read_timeout(Some(Duration::from_millis(1)))?;
    loop {
        match queue.wait(POLL_INTERVAL) {
            Arrival::Message(message) => write_frame(stream, &message)?,
            Arrival::Nothing if has_ended(stream) => return Ok(()),
            Arrival::Nothing => {}
            Arrival::Closed => return Ok(()),
        }
    }
}

fn has_ended(stream: &TcpStream) -> bool {
    match stream.peek(&mut [0]) {
        Ok(count) => count == 0,
        Err(error) => !matches!(
            error.kind(),
            ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
        ),
    }
}

impl Drop for Topic {
    fn drop(&mut self) {
        self.node.forget_topic(&self.name);
        for subscriber in &self.state().subscribers {
            subscriber.queue.close();
            // Shutting down fails only if the connection is closed already.
            let _ = subscriber.stream.shutdown(Shutdown::Both);
        }
    }
}
