//! The network of ROS 1 on the tape of the simulator: a replay has what came from there, and no node.

use capture::{Input, Recorded, Tape};
use ros1::{MessageType, NodeSettings, ServiceType, XmlRpcValue};

/// The node in its network.
pub(super) struct Network {
    /// None in a replay.
    node: Option<ros1::Node>,
    has_no_master: bool,
    tape: Tape,
}

/// Why something was not done.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{text}")]
pub(super) struct Failure {
    text: String,
    kind: Kind,
}

/// Failures that are told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    NoMaster = 0,
    Refused = 1,
    Other = 2,
}

/// A parameter. Lists and the like are of no kind that scripts can ask for.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Parameter {
    Bool(bool),
    Int(i32),
    Double(f64),
    Text(String),
    Other,
}

type Outcome<T> = Result<T, Failure>;

impl Failure {
    /// No master answers.
    pub(super) fn is_no_master(&self) -> bool {
        self.kind == Kind::NoMaster
    }

    /// The master has answered that it did not do it.
    pub(super) fn is_refusal(&self) -> bool {
        self.kind == Kind::Refused
    }
}

impl From<ros1::Error> for Failure {
    fn from(error: ros1::Error) -> Self {
        let kind = match &error {
            ros1::Error::Master { .. } => Kind::NoMaster,
            ros1::Error::Refused { .. } => Kind::Refused,
            _ => Kind::Other,
        };
        Self {
            text: error.to_string(),
            kind,
        }
    }
}

impl From<capture::Lost> for Failure {
    fn from(lost: capture::Lost) -> Self {
        Self {
            text: lost.to_string(),
            kind: Kind::Other,
        }
    }
}

impl Recorded for Failure {
    fn write(&self, out: &mut Vec<u8>) {
        self.text.write(out);
        (self.kind as u8).write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let text = Recorded::read(input)?;
        let kind = match u8::read(input)? {
            0 => Kind::NoMaster,
            1 => Kind::Refused,
            2 => Kind::Other,
            _ => return None,
        };
        Some(Self { text, kind })
    }
}

impl From<XmlRpcValue> for Parameter {
    fn from(value: XmlRpcValue) -> Self {
        match value {
            XmlRpcValue::Bool(value) => Self::Bool(value),
            XmlRpcValue::Int(value) => Self::Int(value),
            XmlRpcValue::Double(value) => Self::Double(value),
            XmlRpcValue::String(value) => Self::Text(value),
            _ => Self::Other,
        }
    }
}

impl Recorded for Parameter {
    fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Bool(value) => (0_u8, *value).write(out),
            Self::Int(value) => (1_u8, *value).write(out),
            Self::Double(value) => (2_u8, *value).write(out),
            Self::Text(value) => (3_u8, value.clone()).write(out),
            Self::Other => 4_u8.write(out),
        }
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some(match u8::read(input)? {
            0 => Self::Bool(Recorded::read(input)?),
            1 => Self::Int(Recorded::read(input)?),
            2 => Self::Double(Recorded::read(input)?),
            3 => Self::Text(Recorded::read(input)?),
            4 => Self::Other,
            _ => return None,
        })
    }
}

impl Network {
    /// # Errors
    /// When no master answers, or the settings are wrong.
    pub(super) fn new(settings: &NodeSettings, tape: &Tape) -> Outcome<Self> {
        Self::made(tape, false, || ros1::Node::new(settings))
    }

    /// A node that is alone.
    ///
    /// # Errors
    /// When the settings are wrong.
    pub(super) fn without_master(settings: &NodeSettings, tape: &Tape) -> Outcome<Self> {
        Self::made(tape, true, || ros1::Node::without_master(settings))
    }

    fn made(
        tape: &Tape,
        has_no_master: bool,
        make: impl FnOnce() -> ros1::Result<ros1::Node>,
    ) -> Outcome<Self> {
        Ok(Self {
            node: opened(tape, "a node of ROS", make)?,
            has_no_master,
            tape: tape.clone(),
        })
    }

    pub(super) fn has_no_master(&self) -> bool {
        self.has_no_master
    }

    /// What the node does, and its result, which in a replay comes from the capture.
    fn asked<T: Recorded>(
        &self,
        kind: &str,
        ask: impl FnOnce(&ros1::Node) -> ros1::Result<T>,
    ) -> Outcome<T> {
        let lost = || Err(capture::Lost.into());
        let ask = || {
            let node = self.node.as_ref();
            node.map_or_else(lost, |node| ask(node).map_err(Failure::from))
        };
        self.tape.input(kind, ask)?
    }

    /// Something of the node; None in a replay.
    fn opened<T>(
        &self,
        kind: &str,
        open: impl FnOnce(&ros1::Node) -> ros1::Result<T>,
    ) -> Outcome<Option<T>> {
        let mut opened = None;
        self.asked(kind, |node| {
            opened = Some(open(node)?);
            Ok(())
        })?;
        Ok(opened)
    }

    pub(super) fn publish(
        &self,
        topic: &str,
        message_type: &MessageType,
        queue: usize,
        is_latched: bool,
    ) -> Outcome<Publisher> {
        let publish = |node: &ros1::Node| node.publish(topic, message_type, queue, is_latched);
        Ok(Publisher(self.opened("a publisher of ROS", publish)?))
    }

    pub(super) fn subscribe(
        &self,
        topic: &str,
        message_type: &MessageType,
        queue: usize,
    ) -> Outcome<Subscriber> {
        let subscribe = |node: &ros1::Node| node.subscribe(topic, message_type, queue);
        Ok(Subscriber {
            subscriber: self.opened("a subscriber of ROS", subscribe)?,
            tape: self.tape.clone(),
        })
    }

    pub(super) fn offer(&self, service: &str, service_type: &ServiceType) -> Outcome<Server> {
        let offer = |node: &ros1::Node| node.offer(service, service_type);
        Ok(Server {
            server: self.opened("a service of ROS", offer)?,
            tape: self.tape.clone(),
        })
    }

    pub(super) fn call(
        &self,
        service: &str,
        service_type: &ServiceType,
        request: Vec<u8>,
    ) -> Outcome<Call> {
        let call = |node: &ros1::Node| node.call(service, service_type, request);
        Ok(Call {
            call: self.opened("a call of a service of ROS", call)?,
            tape: self.tape.clone(),
        })
    }

    pub(super) fn parameter(&self, name: &str) -> Outcome<Option<Parameter>> {
        self.asked("a parameter of ROS", |node| {
            Ok(node.parameter(name)?.map(Parameter::from))
        })
    }

    pub(super) fn set_parameter(&self, name: &str, value: XmlRpcValue) -> Outcome<()> {
        self.asked("setting a parameter of ROS", |node| {
            node.set_parameter(name, value)
        })
    }

    pub(super) fn has_parameter(&self, name: &str) -> Outcome<bool> {
        self.asked("whether ROS has a parameter", |node| {
            node.has_parameter(name)
        })
    }

    pub(super) fn delete_parameter(&self, name: &str) -> Outcome<()> {
        self.asked("removing a parameter of ROS", |node| {
            node.delete_parameter(name)
        })
    }

    pub(super) fn search_parameter(&self, name: &str) -> Outcome<Option<String>> {
        self.asked("the name of a parameter of ROS", |node| {
            node.search_parameter(name)
        })
    }
}

/// What a function makes; None in a replay.
fn opened<T>(
    tape: &Tape,
    kind: &str,
    make: impl FnOnce() -> ros1::Result<T>,
) -> Outcome<Option<T>> {
    let mut made = None;
    let outcome = tape.input(kind, || {
        made = Some(make()?);
        Ok::<(), Failure>(())
    });
    outcome??;
    Ok(made)
}

/// What writes a topic.
pub(super) struct Publisher(Option<ros1::Publisher>);

impl Publisher {
    pub(super) fn publish(&self, message: Vec<u8>) {
        if let Some(publisher) = &self.0 {
            publisher.publish(message);
        }
    }

    /// How many nodes it is sent to. Not on the tape.
    pub(super) fn subscribers(&self) -> usize {
        self.0.as_ref().map_or(0, ros1::Publisher::subscribers)
    }
}

/// What reads a topic.
pub(super) struct Subscriber {
    subscriber: Option<ros1::Subscriber>,
    tape: Tape,
}

impl Subscriber {
    fn asked<T: Recorded + Default>(
        &self,
        kind: &str,
        ask: impl FnOnce(&ros1::Subscriber) -> T,
    ) -> T {
        let ask = || self.subscriber.as_ref().map(ask).unwrap_or_default();
        self.tape.input(kind, ask).unwrap_or_default()
    }

    pub(super) fn take(&self) -> Option<Vec<u8>> {
        self.asked("a message of ROS", ros1::Subscriber::take)
    }

    pub(super) fn waiting(&self) -> usize {
        self.asked("how many messages of ROS wait", ros1::Subscriber::waiting)
    }

    pub(super) fn problem(&self) -> Option<String> {
        self.asked("a problem of ROS", ros1::Subscriber::problem)
    }
}

/// What answers requests of a service.
pub(super) struct Server {
    server: Option<ros1::ServiceServer>,
    tape: Tape,
}

/// A request of a service.
pub(super) struct Request {
    pub(super) bytes: Vec<u8>,
    request: Option<ros1::Request>,
}

impl Server {
    pub(super) fn take(&self) -> Option<Request> {
        let mut request = None;
        let bytes = self.tape.input("a request of ROS", || {
            request = self.server.as_ref()?.take();
            request.as_ref().map(|request| request.bytes.clone())
        });
        let bytes = bytes.ok()??;
        Some(Request { bytes, request })
    }
}

impl Request {
    pub(super) fn answer(self, answer: Result<Vec<u8>, String>) {
        if let Some(request) = self.request {
            request.answer(answer);
        }
    }
}

/// A call of a service whose answer comes later.
pub(super) struct Call {
    call: Option<ros1::ServiceCall>,
    tape: Tape,
}

impl Call {
    pub(super) fn poll(&self) -> Option<Outcome<Vec<u8>>> {
        let poll = || {
            let answer = self.call.as_ref()?.poll()?;
            Some(answer.map_err(Failure::from))
        };
        let answer = self.tape.input("an answer of a service of ROS", poll);
        answer.unwrap_or_else(|lost| Some(Err(lost.into())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn again<T: Recorded>(value: &T) -> Option<T> {
        let mut bytes = Vec::new();
        value.write(&mut bytes);
        let mut input = Input::new(&bytes);
        T::read(&mut input).filter(|_| input.is_empty())
    }

    #[test]
    fn values_come_back() {
        let values = [
            Parameter::Bool(true),
            Parameter::Int(-7),
            Parameter::Double(0.5),
            Parameter::Text("x".into()),
            Parameter::Other,
        ];
        for value in values {
            assert_eq!(again(&value).as_ref(), Some(&value));
        }
        let refused: Failure = ros1::Error::Refused {
            method: "m".into(),
            reason: "r".into(),
        }
        .into();
        assert!(refused.is_refusal() && !refused.is_no_master());
        assert_eq!(again(&refused), Some(refused));
        assert_eq!(Parameter::read(&mut Input::new(&[9])), None);
    }
}
