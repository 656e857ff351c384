//! The node: how it comes to be, what belongs to it, and the calls of its callbacks.

use std::cell::RefCell;
use std::rc::Rc;

use capture::Tape;
use ros_interfaces::{Catalogue, Generation, Layout};
use rtps::{Core, Network, Participant, Qos};

use super::actions::{ActionClient, ActionServer};
use super::endpoint::Endpoint;
use super::graph::{self, Graph};
use super::names::{self, Place};
use super::parameter_services::ParameterServices;
use super::parameters::Parameters;
use super::rosout::{self, RosOut};
use super::services::{Client, Service};
use super::topics::{Publisher, Subscription};
use super::{ApiError, Cx, Result, discovery, interfaces};
use crate::ros_entities::Entities;
use script::log::verbosity;
use script::{Host, RosOptions};

/// The state of the module.
#[derive(Default)]
pub(super) struct Node {
    running: RefCell<Option<Rc<Running>>>,
    catalogue: RefCell<Option<Catalogue>>,
    pub(super) entities: Rc<Entities<Entity>>,
    pub(super) parameters: RefCell<Parameters>,
    /// For transforms.
    pub(super) broadcaster: RefCell<Option<Rc<Publisher>>>,
    pub(super) graph: RefCell<Option<Rc<Graph>>>,
    parameter_services: RefCell<Option<Rc<ParameterServices>>>,
    pub(super) rosout: RefCell<Option<Rc<RosOut>>>,
}

/// The node in its domain.
pub(super) struct Running {
    /// None in a replay.
    participant: Option<Participant>,
    pub(super) tape: Tape,
    pub(super) place: Place,
}

/// What scripts have a handle of.
#[derive(Clone)]
pub(super) enum Entity {
    Publisher(Rc<Publisher>),
    Subscription(Rc<Subscription>),
    Client(Rc<Client>),
    Service(Rc<Service>),
    ActionClient(Rc<ActionClient>),
    ActionServer(Rc<ActionServer>),
}

impl Node {
    /// The types that are known.
    pub(super) fn with_catalogue<T>(
        &self,
        options: &RosOptions,
        action: impl FnOnce(&mut Catalogue) -> T,
    ) -> T {
        let mut catalogue = self.catalogue.borrow_mut();
        action(catalogue.get_or_insert_with(|| {
            let mut catalogue = Catalogue::new(Generation::Ros2);
            options
                .interface_folders()
                .for_each(|folder| catalogue.add_folder(folder));
            catalogue
        }))
    }

    /// Calls the callbacks for what has arrived: one after the other in the order of creation. What arrives in the meantime waits.
    pub(super) fn spin(&self) {
        let graph = self.graph.borrow().clone();
        if let Some(graph) = graph {
            graph.publish_changes();
        }
        let services = self.parameter_services.borrow().clone();
        if let Some(services) = services {
            services.spin(&self.parameters);
        }
        self.entities.for_each(|entity| match entity {
            Entity::Subscription(subscription) => subscription.spin(),
            Entity::Service(service) => service.spin(),
            Entity::ActionClient(client) => client.spin(),
            Entity::ActionServer(server) => server.spin(),
            Entity::Publisher(_) | Entity::Client(_) => {}
        });
    }
}

impl Running {
    /// What the participant does; None in a replay.
    pub(super) fn core<T>(&self, action: impl FnOnce(&mut Core) -> T) -> Option<T> {
        Some(self.participant.as_ref()?.with(action))
    }

    /// The writer of a topic of ROS.
    pub(super) fn publisher(
        self: &Rc<Self>,
        name: &str,
        layout: &Layout,
        qos: Qos,
    ) -> Result<Endpoint> {
        Ok(Endpoint::writer(
            self,
            &names::topic(&self.resolve(name)?),
            layout,
            qos,
        ))
    }

    /// The reader of a topic of ROS.
    pub(super) fn subscription(
        self: &Rc<Self>,
        name: &str,
        layout: &Layout,
        qos: Qos,
    ) -> Result<Endpoint> {
        Ok(Endpoint::reader(
            self,
            &names::topic(&self.resolve(name)?),
            layout,
            qos,
        ))
    }

    pub(super) fn resolve(&self, name: &str) -> Result<String> {
        self.place.resolve(name).map_err(ApiError::Other)
    }
}

/// The hook of the module.
pub(super) fn start_of_iteration(host: &Host) {
    if let Some(node) = host.module_state::<Node>() {
        node.spin();
    }
}

pub(super) fn node(cx: &Cx) -> Rc<Node> {
    cx.module_state()
}

/// The node in its domain, which the first call makes.
///
/// # Errors
/// When that is not allowed, or there is no such domain or no socket.
pub(super) fn running(cx: &Cx) -> Result<Rc<Running>> {
    let node = node(cx);
    if let Some(running) = node.running.borrow().as_ref() {
        return Ok(running.clone());
    }
    let options = &cx.options().ros;
    let param = |name: &str| {
        cx.app()
            .named_params
            .get(name)
            .map(|value| String::from_utf8_lossy(value).into_owned())
    };
    let domain = param("ROS2Interface.domainId").unwrap_or_else(|| options.domain.clone());
    let domain = if domain.is_empty() {
        Ok(0)
    } else {
        domain.trim().parse()
    };
    let domain = domain
        .map_err(|_| ApiError::Other("ROS 2: the domain (ROS_DOMAIN_ID) is no number".into()))?;
    let name = param("ROS2Interface.nodeName").unwrap_or_else(|| "sim_ros2_interface".into());
    let network = match options.network {
        None => {
            cx.permissions().check_net("127.0.0.1", Some(7400))?;
            Network::Loopback
        }
        Some(address) => {
            cx.permissions().check_net_everywhere("ROS 2")?;
            Network::Address(address)
        }
    };
    let mut participant = None;
    let tape = cx.permissions().tape().clone();
    let made = tape.input("a node of ROS 2", || {
        let (made, warnings) = participant_of(options, domain, network, &name)?;
        participant = Some(made);
        Ok(warnings)
    });
    let warnings = made?.map_err(|error: String| ApiError::Other(format!("ROS 2: {error}")))?;
    for warning in warnings {
        cx.env().log(verbosity::SCRIPT_WARNINGS, &warning);
    }
    let running = Rc::new(Running {
        participant,
        tape,
        place: Place::new(&options.namespace, &name),
    });
    *node.running.borrow_mut() = Some(running.clone());
    let layout = interfaces::message(cx, graph::TYPE)?;
    *node.graph.borrow_mut() = Some(Rc::new(Graph::new(&running, layout)));
    let layout = interfaces::message(cx, rosout::TYPE)?;
    *node.rosout.borrow_mut() = Some(Rc::new(RosOut::new(&running, layout)));
    let services = ParameterServices::new(cx, &running)?;
    *node.parameter_services.borrow_mut() = Some(Rc::new(services));
    Ok(running)
}

/// A participant of the domain, and what the user should know of it.
fn participant_of(
    options: &RosOptions,
    domain: u32,
    network: Network,
    name: &str,
) -> std::result::Result<(Participant, Vec<String>), String> {
    let (discovery, mut warnings) = discovery::discovery(options)?;
    let made = Participant::new(domain, network, &discovery, name, b"enclave=/;");
    let participant = made.map_err(|error| error.to_string())?;
    if let Some(error) = participant.multicast_error() {
        warnings.push(format!(
            "ROS 2: there is no multicast ({error}): nodes are found on this machine and at ROS_STATIC_PEERS"
        ));
    }
    Ok((participant, warnings))
}

/// Adds something of the calling script. Returns its handle.
pub(super) fn add(cx: &Cx, entity: Entity) -> String {
    node(cx).entities.add(cx, entity)
}

/// What a handle stands for, if it is of the kind that `choose` accepts.
///
/// # Errors
/// When it is not.
pub(super) fn get<T>(cx: &Cx, handle: &str, choose: impl Fn(Entity) -> Option<T>) -> Result<T> {
    node(cx).entities.get(handle, choose)
}

/// Ends what a handle stands for, if it is of the kind that `choose` accepts.
///
/// # Errors
/// When it is not.
pub(super) fn shut_down<T>(
    cx: &Cx,
    handle: &str,
    choose: impl Fn(Entity) -> Option<T>,
) -> Result<()> {
    node(cx).entities.shut_down(handle, choose)
}
