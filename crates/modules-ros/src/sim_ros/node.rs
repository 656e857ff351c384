//! The node: how it comes to be, what belongs to it, its clock, and the calls of its callbacks.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use api_macro::api;
use capture::Tape;
use ros_interfaces::{
    Catalogue, Generation, InterfaceError, InterfaceKind, Layout, TypeName, Value,
};
use ros1::{MessageType, NodeNetwork, NodeSettings, ServiceType};

use super::network::{Network, Parameter, Subscriber};
use super::services::{Client, Service};
use super::topics::{Publisher, Subscription};
use super::{ApiError, ApiFn, Cx, Result, failed, functions};
use crate::ros_entities::Entities;
use script::Host;
use script::log::verbosity;
use script::wall_clock;

pub(super) const FUNCTIONS: &[ApiFn] = functions![get_time];

/// The state of the module. What scripts have made ends before the node.
#[derive(Default)]
pub(super) struct Node {
    entities: Rc<Entities<Entity>>,
    /// For transforms.
    pub(super) broadcaster: RefCell<Option<Rc<Publisher>>>,
    running: RefCell<Option<Rc<Running>>>,
    catalogue: RefCell<Option<Catalogue>>,
}

/// The node in its network.
pub(super) struct Running {
    pub(super) node: Network,
    /// Where simulated time comes from, if the parameter `/use_sim_time` says so.
    clock: Option<Clock>,
}

struct Clock {
    subscriber: Subscriber,
    layout: Arc<Layout>,
    seconds: Cell<f64>,
}

/// What scripts have a handle of.
#[derive(Clone)]
pub(super) enum Entity {
    Publisher(Rc<Publisher>),
    Subscription(Rc<Subscription>),
    Client(Rc<Client>),
    Service(Rc<Service>),
}

impl Node {
    fn with_catalogue<T>(&self, cx: &Cx, action: impl FnOnce(&mut Catalogue) -> T) -> T {
        let mut catalogue = self.catalogue.borrow_mut();
        action(catalogue.get_or_insert_with(|| {
            let mut catalogue = Catalogue::new(Generation::Ros1);
            cx.options()
                .ros
                .package_folders()
                .for_each(|folder| catalogue.add_folder(folder));
            catalogue
        }))
    }

    /// Calls the callbacks for what has arrived: one after the other in the order of creation. What arrives in the meantime waits.
    pub(super) fn spin(&self) {
        let running = self.running.borrow().clone();
        if let Some(clock) = running.as_ref().and_then(|running| running.clock.as_ref()) {
            clock.read();
        }
        self.entities.for_each(|entity| match entity {
            Entity::Subscription(subscription) => subscription.spin(),
            Entity::Service(service) => service.spin(),
            Entity::Publisher(_) | Entity::Client(_) => {}
        });
    }

    /// Simulated time, or the system's.
    pub(super) fn time(&self, tape: &Tape) -> f64 {
        let running = self.running.borrow();
        let clock = running.as_ref().and_then(|running| running.clock.as_ref());
        let system = || tape.input("the time of ROS", wall_clock::unix_seconds);
        clock.map_or_else(|| system().unwrap_or_default(), |clock| clock.seconds.get())
    }
}

impl Clock {
    /// Takes the newest time.
    fn read(&self) {
        while let Some(message) = self.subscriber.take() {
            let record = ros_interfaces::ros1::decode(&self.layout, &message);
            if let Some(Value::Time(time)) =
                record.as_ref().ok().and_then(|record| record.get("clock"))
            {
                self.seconds
                    .set(f64::from(time.sec) + f64::from(time.nanosec) * 1e-9);
            }
        }
    }
}

/// The hook of the module.
pub(super) fn start_of_iteration(host: &Host) {
    if let Some(node) = host.module_state::<Node>() {
        node.spin();
    }
}

/// The time of ROS: that of the topic `/clock` if the parameter `/use_sim_time` is true, else the system's.
///
/// @param flag not used, as in CoppeliaSim
/// @return time seconds since 1970
#[api("simROS.getTime")]
fn get_time(cx: &mut Cx, #[default(0)] _flag: i64) -> Result<f64> {
    running(cx)?;
    Ok(node(cx).time(cx.permissions().tape()))
}

pub(super) fn node(cx: &Cx) -> Rc<Node> {
    cx.module_state()
}

/// The node in its network, which the first call makes. Without a master it is alone, which is logged once, unless the options say otherwise.
///
/// # Errors
/// When that is not allowed, or there is no master and the options ask for one.
pub(super) fn running(cx: &Cx) -> Result<Rc<Running>> {
    let node = node(cx);
    if let Some(running) = node.running.borrow().as_ref() {
        return Ok(running.clone());
    }
    let settings = settings(cx)?;
    let tape = cx.permissions().tape();
    let running = match Network::new(&settings, tape) {
        Err(error) if error.is_no_master() && !cx.options().ros.needs_master => {
            let warning = format!(
                "ROS: {error}. Functions of simROS do nothing in this run; --ros-needs-master makes that an error"
            );
            cx.env().log(verbosity::SCRIPT_WARNINGS, &warning);
            Network::without_master(&settings, tape)
        }
        made => made,
    };
    let running = running.map_err(|error| failed(&error))?;
    let clock = clock(cx, &running)?;
    let running = Rc::new(Running {
        node: running,
        clock,
    });
    *node.running.borrow_mut() = Some(running.clone());
    Ok(running)
}

fn settings(cx: &Cx) -> Result<NodeSettings> {
    let options = &cx.options().ros;
    let name = cx
        .app()
        .named_params
        .get("ROSInterface.nodeName")
        .map(|name| String::from_utf8_lossy(name).into_owned());
    let network = match options.network {
        None => {
            cx.permissions().check_net("127.0.0.1", None)?;
            NodeNetwork::Loopback
        }
        Some(address) => {
            cx.permissions().check_net_everywhere("ROS")?;
            NodeNetwork::Address(address)
        }
    };
    Ok(NodeSettings {
        master: options.master_uri().into(),
        network,
        namespace: options.namespace.clone(),
        name: name.unwrap_or_else(|| "sim_ros_interface".into()),
    })
}

fn clock(cx: &Cx, running: &Network) -> Result<Option<Clock>> {
    let parameter = running
        .parameter("/use_sim_time")
        .map_err(|error| failed(&error))?;
    if parameter != Some(Parameter::Bool(true)) {
        return Ok(None);
    }
    let layout = message(cx, "rosgraph_msgs/Clock")?;
    let subscriber = running
        .subscribe("/clock", &message_type(&layout), 1)
        .map_err(|error| failed(&error))?;
    Ok(Some(Clock {
        subscriber,
        layout,
        seconds: Cell::new(0.0),
    }))
}

/// The type of a topic.
///
/// # Errors
/// When it is not known.
pub(super) fn message(cx: &Cx, name: &str) -> Result<Arc<Layout>> {
    let is_message = TypeName::parse(name, InterfaceKind::Message)
        .is_ok_and(|name| name.kind == InterfaceKind::Message);
    let unknown = || Err(InterfaceError::Unknown(name.into()));
    let layout = if is_message {
        node(cx).with_catalogue(cx, |catalogue| catalogue.layout(name))
    } else {
        unknown()
    };
    layout.map_err(|error| unsupported("message", name, &error))
}

/// The types of request and response of a service.
///
/// # Errors
/// When it is not known.
pub(super) fn service(cx: &Cx, name: &str) -> Result<[Arc<Layout>; 2]> {
    let layouts = node(cx).with_catalogue(cx, |catalogue| catalogue.service(name));
    layouts.map_err(|error| unsupported("service", name, &error))
}

fn unsupported(kind: &str, name: &str, error: &InterfaceError) -> ApiError {
    ApiError::Other(format!(
        "Unsupported {kind} type '{name}': {error}. Folders with .msg and .srv files: --ros-interfaces"
    ))
}

/// As both sides of a connection compare it.
pub(super) fn message_type(layout: &Arc<Layout>) -> MessageType {
    MessageType {
        name: layout.name.short(),
        md5: ros_interfaces::ros1::md5(layout),
        definition: ros_interfaces::ros1::definition(layout),
    }
}

pub(super) fn service_type(name: &str, [request, response]: &[Arc<Layout>; 2]) -> ServiceType {
    let short = TypeName::parse(name, InterfaceKind::Service)
        .map_or_else(|_| name.to_string(), |name| name.short());
    ServiceType {
        name: short,
        md5: ros_interfaces::ros1::service_md5(request, response),
    }
}

/// How many messages a script wants to keep; 0 is as many as possible.
///
/// # Errors
/// When it is negative.
pub(super) fn queue_size(size: i64) -> Result<usize> {
    usize::try_from(size).map_err(|_| ApiError::Other(format!("invalid queue size: {size}")))
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
