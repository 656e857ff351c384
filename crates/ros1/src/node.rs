//! The node.

use std::collections::BTreeMap;
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, Weak};

use crate::master::Master;
use crate::name::Place;
use crate::network::NodeNetwork;
use crate::publisher::{Publisher, Topic};
use crate::service::{Service, ServiceCall, ServiceServer, ServiceType};
use crate::subscriber::{Subscriber, Subscription};
use crate::tcpros::{Server, field, read_head, write_head};
use crate::{Error, MessageType, Result, XmlRpcValue, http, limits, slave};
use heap::resource::Resource;

/// How a node takes part.
#[derive(Clone, Debug)]
pub struct NodeSettings {
    /// The address of the master, `http://localhost:11311`.
    pub master: String,
    /// Which addresses are bound and reached.
    pub network: NodeNetwork,
    /// Where names without a slash belong; empty for none.
    pub namespace: String,
    /// The name of the node.
    pub name: String,
}

/// A node of ROS 1. What it has made works on until it is dropped itself.
pub struct Node {
    shared: Arc<Shared>,
    place: Place,
    _servers: [Server; 2],
    _resource: Resource,
}

/// What its threads share.
pub(crate) struct Shared {
    pub(crate) network: NodeNetwork,
    pub(crate) master: Master,
    host: String,
    /// Of XML-RPC and of TCPROS; set before anyone knows of the node.
    ports: OnceLock<[u16; 2]>,
    /// Whether it did not answer when something ended: then it is not asked again at each further end.
    has_no_master: AtomicBool,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    topics: BTreeMap<String, Weak<Topic>>,
    subscriptions: Vec<Arc<Subscription>>,
    services: BTreeMap<String, Weak<Service>>,
}

impl Node {
    /// Starts a node. Its master has to be there.
    ///
    /// # Errors
    /// When a name or an address is none, no socket can be had, or no master answers within a few seconds.
    pub fn new(settings: &NodeSettings) -> Result<Self> {
        let place = Place::new(&settings.namespace, &settings.name)?;
        let master = Master::new(&settings.master, settings.network, &place.node)?;
        let host = settings
            .network
            .own_host(master.place())
            .map_err(|error| no_master(&master, &error))?;
        // Before anything is bound: without a master there is no node.
        master.call("getPid", &[])?;
        Self::start(place, master, settings.network, host)
    }

    /// Starts a node that asks for no master and meets no other node: what it publishes reaches nobody, its parameters are its own, and there are
    /// no services.
    ///
    /// # Errors
    /// When a name or an address is none, or no socket can be had.
    pub fn without_master(settings: &NodeSettings) -> Result<Self> {
        let place = Place::new(&settings.namespace, &settings.name)?;
        let network = NodeNetwork::Loopback;
        let master = Master::new(&settings.master, network, &place.node)?.absent();
        let host = network.own_host(master.place())?;
        Self::start(place, master, network, host)
    }

    fn start(place: Place, master: Master, network: NodeNetwork, host: String) -> Result<Self> {
        let (ports, has_no_master) = (OnceLock::new(), AtomicBool::new(false));
        let shared = Arc::new(Shared {
            network,
            master,
            host,
            ports,
            has_no_master,
            state: Mutex::default(),
        });
        let (api, messages) = (Arc::downgrade(&shared), Arc::downgrade(&shared));
        let servers = [
            Server::start(network.listen()?, "ROS API", move |stream| {
                serve_api(&api, stream);
            })?,
            Server::start(network.listen()?, "ROS messages", move |stream| {
                serve_messages(&messages, stream);
            })?,
        ];
        shared
            .ports
            .get_or_init(|| [servers[0].port(), servers[1].port()]);
        Ok(Self {
            shared,
            place,
            _servers: servers,
            _resource: Resource::new(|| "the node of ROS 1".to_owned()),
        })
    }

    /// Whether it works without a master.
    #[must_use]
    pub fn has_no_master(&self) -> bool {
        self.shared.master.is_absent()
    }

    /// Its name, with the namespace.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.place.node
    }

    /// Publishes a topic. Of several publishers of one topic the largest queue counts, and whether one of them is latched:
    /// then new subscribers receive the last message. A queue size of 0 is as large as queues may be.
    ///
    /// # Errors
    /// When the name is none, the topic has another type here, or the master cannot be asked.
    pub fn publish(
        &self,
        topic: &str,
        message_type: &MessageType,
        queue_size: usize,
        is_latched: bool,
    ) -> Result<Publisher> {
        let name = self.place.resolve(topic)?;
        if let Some(known) = self.shared.topic(&name) {
            if known.message_type.md5 != message_type.md5 {
                let problem = format!(
                    "topic {name} is published with type {} already",
                    known.message_type.name
                );
                return Err(Error::Peer(problem));
            }
            known.widen(queue_size, is_latched);
            return Ok(Publisher::new(known));
        }
        let topic = Arc::new(Topic::new(
            name.clone(),
            message_type.clone(),
            self.shared.clone(),
        ));
        topic.widen(queue_size, is_latched);
        self.shared
            .state()
            .topics
            .insert(name.clone(), Arc::downgrade(&topic));
        let publisher = Publisher::new(topic);
        self.shared.master.call(
            "registerPublisher",
            &[&name, &message_type.name, &self.shared.api_uri()],
        )?;
        Ok(publisher)
    }

    /// Subscribes to a topic. The newest `queue_size` messages wait; 0 is as many as there may be at all.
    ///
    /// # Errors
    /// When the name is none, or the master cannot be asked.
    pub fn subscribe(
        &self,
        topic: &str,
        message_type: &MessageType,
        queue_size: usize,
    ) -> Result<Subscriber> {
        let name = self.place.resolve(topic)?;
        let subscriber =
            Subscriber::new(&self.shared, name.clone(), message_type.clone(), queue_size);
        self.shared
            .state()
            .subscriptions
            .push(subscriber.subscription.clone());
        let arguments = [&name, &message_type.name, &self.shared.api_uri()];
        let publishers = self
            .shared
            .master
            .call("registerSubscriber", &arguments.map(String::as_str))?;
        let publishers = publishers
            .as_array()
            .unwrap_or_default()
            .iter()
            .filter_map(XmlRpcValue::as_text);
        subscriber
            .subscription
            .update(&publishers.map(String::from).collect::<Vec<_>>());
        Ok(subscriber)
    }

    /// Offers a service.
    ///
    /// # Errors
    /// When the name is none, the node offers it already, or the master cannot be asked.
    pub fn offer(&self, service: &str, service_type: &ServiceType) -> Result<ServiceServer> {
        let name = self.place.resolve(service)?;
        if self.shared.service(&name).is_some() {
            return Err(Error::Peer(format!("service {name} is offered already")));
        }
        let server = ServiceServer::new(&self.shared, name.clone(), service_type.clone());
        self.shared
            .state()
            .services
            .insert(name.clone(), Arc::downgrade(server.service()));
        let uri = format!("rosrpc://{}:{}", self.shared.host, self.shared.ports()[1]);
        self.shared
            .master
            .call("registerService", &[&name, &uri, &self.shared.api_uri()])?;
        Ok(server)
    }

    /// Begins to call a service.
    ///
    /// # Errors
    /// When the name is none, or the system has no thread.
    pub fn call(
        &self,
        service: &str,
        service_type: &ServiceType,
        request: Vec<u8>,
    ) -> Result<ServiceCall> {
        ServiceCall::start(
            &self.shared,
            &self.place.resolve(service)?,
            service_type,
            request,
        )
    }

    /// The value of a parameter. None if there is none.
    ///
    /// # Errors
    /// When the name is none, or the master cannot be asked.
    pub fn parameter(&self, name: &str) -> Result<Option<XmlRpcValue>> {
        match self
            .shared
            .master
            .call("getParam", &[&self.place.resolve(name)?])
        {
            Ok(value) => Ok(Some(value)),
            Err(Error::Refused { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// When the name is none, or the master cannot be asked.
    pub fn set_parameter(&self, name: &str, value: XmlRpcValue) -> Result<()> {
        let name = XmlRpcValue::String(self.place.resolve(name)?);
        self.shared
            .master
            .call_with("setParam", vec![name, value])
            .map(drop)
    }

    /// Whether there is a parameter.
    ///
    /// # Errors
    /// When the name is none, or the master cannot be asked.
    pub fn has_parameter(&self, name: &str) -> Result<bool> {
        Ok(self
            .shared
            .master
            .call("hasParam", &[&self.place.resolve(name)?])?
            == XmlRpcValue::Bool(true))
    }

    /// Removes a parameter.
    ///
    /// # Errors
    /// When there is none, the name is none, or the master cannot be asked.
    pub fn delete_parameter(&self, name: &str) -> Result<()> {
        self.shared
            .master
            .call("deleteParam", &[&self.place.resolve(name)?])
            .map(drop)
    }

    /// The full name of a parameter in the namespace of the node, or in one that contains it. None if there is none.
    ///
    /// # Errors
    /// When the master cannot be asked.
    pub fn search_parameter(&self, name: &str) -> Result<Option<String>> {
        match self.shared.master.call("searchParam", &[name]) {
            Ok(value) => Ok(value.as_text().map(String::from)),
            Err(Error::Refused { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }
}

fn no_master(master: &Master, error: &Error) -> Error {
    Error::Master {
        uri: master.uri.clone(),
        problem: error.to_string(),
    }
}

/// What is not understood ends the connection, which is what the other side needs to know.
fn serve_api(node: &Weak<Shared>, mut stream: TcpStream) {
    let no_node = || crate::xmlrpc::fault_text(1, "the node has ended");
    let _ = http::serve(&mut stream, |body| {
        node.upgrade()
            .map_or_else(no_node, |node| slave::answer(&node, body))
    });
}

fn serve_messages(node: &Weak<Shared>, stream: TcpStream) {
    let _ = serve_connection(node, stream);
}

fn serve_connection(node: &Weak<Shared>, mut stream: TcpStream) -> Result<()> {
    stream.set_read_timeout(Some(limits::SILENCE_TIMEOUT))?;
    let head = read_head(&mut stream)?;
    let Some(node) = node.upgrade() else {
        return Ok(());
    };
    let caller = node.master.caller.clone();
    let (service, topic) = (field(&head, "service"), field(&head, "topic"));
    match (node.service(service), node.topic(topic)) {
        (Some(service), _) => {
            drop(node);
            service.serve(stream, &head, &caller)
        }
        (None, Some(topic)) => {
            drop(node);
            topic.serve(stream, &head, &caller)
        }
        (None, None) => {
            let what = if service.is_empty() { topic } else { service };
            write_head(
                &mut stream,
                &[("error", &format!("there is no {what} at this node"))],
            )
        }
    }
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn ports(&self) -> [u16; 2] {
        self.ports.get().copied().unwrap_or_default()
    }

    fn api_uri(&self) -> String {
        format!("http://{}:{}/", self.host, self.ports()[0])
    }

    pub(crate) fn tcpros_place(&self) -> (&str, u16) {
        (&self.host, self.ports()[1])
    }

    pub(crate) fn topic(&self, name: &str) -> Option<Arc<Topic>> {
        self.state().topics.get(name)?.upgrade()
    }

    fn service(&self, name: &str) -> Option<Arc<Service>> {
        self.state().services.get(name)?.upgrade()
    }

    pub(crate) fn publications(&self) -> Vec<(String, String)> {
        let topics = self.all_topics();
        topics
            .iter()
            .map(|topic| (topic.name.clone(), topic.message_type.name.clone()))
            .collect()
    }

    pub(crate) fn subscriptions(&self) -> Vec<(String, String)> {
        let subscriptions = self.all_subscriptions();
        subscriptions
            .iter()
            .map(|one| (one.topic.clone(), one.message_type.name.clone()))
            .collect()
    }

    /// The other side, the direction and the topic of each connection.
    pub(crate) fn connections(&self) -> Vec<(String, &'static str, String)> {
        let out = |topic: &Arc<Topic>| {
            let name = topic.name.clone();
            topic
                .callers()
                .into_iter()
                .map(move |caller| (caller, "o", name.clone()))
                .collect::<Vec<_>>()
        };
        let inward = |one: &Arc<Subscription>| {
            let name = one.topic.clone();
            one.publishers()
                .into_iter()
                .map(move |uri| (uri, "i", name.clone()))
                .collect::<Vec<_>>()
        };
        let (topics, subscriptions) = (self.all_topics(), self.all_subscriptions());
        topics
            .iter()
            .flat_map(out)
            .chain(subscriptions.iter().flat_map(inward))
            .collect()
    }

    fn all_topics(&self) -> Vec<Arc<Topic>> {
        self.state()
            .topics
            .values()
            .filter_map(Weak::upgrade)
            .collect()
    }

    fn all_subscriptions(&self) -> Vec<Arc<Subscription>> {
        self.state().subscriptions.clone()
    }

    pub(crate) fn update_publishers(&self, topic: &str, publishers: &[String]) {
        let subscriptions = self.all_subscriptions();
        subscriptions
            .iter()
            .filter(|one| one.topic == topic)
            .for_each(|one| one.update(publishers));
    }

    /// Tells the master of an end. One that cannot be reached needs not know.
    fn unregister(&self, method: &str, name: &str, uri: &str) {
        if !self.has_no_master.load(Ordering::Acquire)
            && let Err(Error::Master { .. }) = self.master.call(method, &[name, uri])
        {
            self.has_no_master.store(true, Ordering::Release);
        }
    }

    /// A topic has no publisher any more, unless there is a new one.
    pub(crate) fn forget_topic(&self, name: &str) {
        let mut state = self.state();
        let is_gone = state
            .topics
            .get(name)
            .is_some_and(|topic| topic.strong_count() == 0);
        if is_gone {
            state.topics.remove(name);
            drop(state);
            self.unregister("unregisterPublisher", name, &self.api_uri());
        }
    }

    /// A subscription has ended.
    pub(crate) fn forget_subscription(&self, ended: &Arc<Subscription>) {
        let mut state = self.state();
        state.subscriptions.retain(|one| !Arc::ptr_eq(one, ended));
        let is_read = state
            .subscriptions
            .iter()
            .any(|one| one.topic == ended.topic);
        drop(state);
        if !is_read {
            self.unregister("unregisterSubscriber", &ended.topic, &self.api_uri());
        }
    }

    /// A service is offered no longer.
    pub(crate) fn forget_service(&self, name: &str) {
        self.state().services.remove(name);
        let uri = format!("rosrpc://{}:{}", self.host, self.ports()[1]);
        self.unregister("unregisterService", name, &uri);
    }
}
