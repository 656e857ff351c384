//! Topics: publishers, subscribers, transforms.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use api_macro::api;
use ros_interfaces::Layout;

use super::images::CompressedTopic;
use super::node::{Entity, add, get, message, message_type, node, queue_size, running, shut_down};
use super::ros_values::{self, Style};
use super::{ApiError, ApiFn, Cx, Result, failed, functions, network};
use crate::ros_images::Content;
use scene::Data;
use script::{ScriptCallback, ScriptFunction, Table};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    advertise,
    publish,
    shutdown_publisher,
    publisher_treat_u_int8_array_as_string,
    subscribe,
    shutdown_subscriber,
    subscriber_treat_u_int8_array_as_string,
    send_transform,
    send_transforms,
];

/// What writes a topic.
pub(super) struct Publisher {
    layout: Arc<Layout>,
    publisher: network::Publisher,
    style: Cell<Style>,
    /// Of images: the topic with the same ones compressed.
    pub(super) compressed: Option<CompressedTopic>,
}

/// What reads a topic.
pub(super) struct Subscription {
    layout: Arc<Layout>,
    subscriber: network::Subscriber,
    style: Cell<Style>,
    callback: ScriptCallback,
    pub(super) content: Content,
    /// Whether a message that cannot be read was reported.
    has_warned: Cell<bool>,
}

impl Publisher {
    /// # Errors
    /// When the name or the type is none, or the master cannot be asked.
    pub(super) fn new(
        cx: &Cx,
        topic: &str,
        kind: &str,
        queue: i64,
        is_latched: bool,
    ) -> Result<Self> {
        let (layout, queue) = (message(cx, kind)?, queue_size(queue)?);
        let publisher = running(cx)?
            .node
            .publish(topic, &message_type(&layout), queue, is_latched);
        let publisher = publisher.map_err(|error| failed(&error))?;
        Ok(Self {
            layout,
            publisher,
            style: Cell::default(),
            compressed: None,
        })
    }

    /// Of images, whose data are strings.
    pub(super) fn of_images(self, compressed: Option<CompressedTopic>) -> Self {
        Self {
            style: Cell::new(Style {
                bytes_as_strings: true,
            }),
            compressed,
            ..self
        }
    }

    /// How many nodes it is sent to.
    pub(super) fn subscribers(&self) -> usize {
        self.publisher.subscribers()
    }

    /// # Errors
    /// When the table is no message of the type.
    pub(super) fn publish(&self, message: &Data) -> Result<()> {
        let record = ros_values::from_data(&self.layout, message, self.style.get())
            .map_err(ApiError::Other)?;
        self.publisher
            .publish(ros_interfaces::ros1::encode(&record));
        Ok(())
    }
}

impl Subscription {
    /// # Errors
    /// When the name or the type is none, or the master cannot be asked.
    pub(super) fn new(
        cx: &Cx,
        topic: &str,
        kind: &str,
        callback: ScriptFunction,
        queue: i64,
    ) -> Result<Self> {
        let (layout, queue) = (message(cx, kind)?, queue_size(queue)?);
        let subscriber = running(cx)?
            .node
            .subscribe(topic, &message_type(&layout), queue);
        let subscriber = subscriber.map_err(|error| failed(&error))?;
        let (style, callback, has_warned) = (
            Cell::default(),
            ScriptCallback::new(cx, callback),
            Cell::default(),
        );
        Ok(Self {
            layout,
            subscriber,
            style,
            callback,
            content: Content::Message,
            has_warned,
        })
    }

    pub(super) fn of_images(self, content: Content) -> Self {
        Self { content, ..self }
    }

    /// Calls back for what has arrived.
    pub(super) fn spin(&self) {
        if let Some(problem) = self.subscriber.problem() {
            self.warn(&problem);
        }
        for _ in 0..self.subscriber.waiting() {
            let Some(message) = self.subscriber.take() else {
                return;
            };
            let args = ros_interfaces::ros1::decode(&self.layout, &message)
                .map_err(|error| error.to_string())
                .and_then(|record| self.content.arguments(&record, self.style.get()));
            match args {
                Ok(args) => drop(self.callback.call_logged(&args)),
                Err(problem) => self.warn(&format!(
                    "a message of type {} was left out: {problem}",
                    self.layout.name
                )),
            }
        }
    }

    /// The first problem only.
    fn warn(&self, problem: &str) {
        if !self.has_warned.replace(true) {
            self.callback.warn(&format!("simROS: {problem}"));
        }
    }
}

fn publisher(entity: Entity) -> Option<Rc<Publisher>> {
    match entity {
        Entity::Publisher(publisher) if publisher.compressed.is_none() => Some(publisher),
        _ => None,
    }
}

fn subscription(entity: Entity) -> Option<Rc<Subscription>> {
    match entity {
        Entity::Subscription(subscription) if !subscription.content.is_image() => {
            Some(subscription)
        }
        _ => None,
    }
}

/// Publishes a topic.
///
/// @param topicName `/x`, `x` in the node's namespace, or `~x` below the node
/// @param topicType `pkg/Name`
/// @param queueSize messages that wait for a slow subscriber; then the newest stay. 0: up to 10000
/// @param latch whether new subscribers receive the last message
/// @return publisherHandle it ends with the script
#[api("simROS.advertise")]
fn advertise(
    cx: &mut Cx,
    topic_name: String,
    topic_type: String,
    #[default(1)] queue_size: i64,
    #[default(false)] latch: bool,
) -> Result<String> {
    let publisher = Publisher::new(cx, &topic_name, &topic_type, queue_size, latch)?;
    Ok(add(cx, Entity::Publisher(Rc::new(publisher))))
}

/// Publishes a message. Fields that are not there have their default.
///
/// @param publisherHandle the publisher
/// @param message a table with the fields of the type; times are seconds
#[api("simROS.publish")]
fn publish(cx: &mut Cx, publisher_handle: String, message: Table) -> Result<()> {
    get(cx, &publisher_handle, publisher)?.publish(&message.0)
}

/// Ends a publisher.
///
/// @param publisherHandle the publisher
#[api("simROS.shutdownPublisher")]
fn shutdown_publisher(cx: &mut Cx, publisher_handle: String) -> Result<()> {
    shut_down(cx, &publisher_handle, publisher)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param publisherHandle the publisher
#[api("simROS.publisherTreatUInt8ArrayAsString")]
fn publisher_treat_u_int8_array_as_string(cx: &mut Cx, publisher_handle: String) -> Result<()> {
    get(cx, &publisher_handle, publisher)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}

/// Subscribes to a topic. The callback gets the message as a table, at the start of an iteration of the loop.
///
/// @param topicName `/x`, `x` in the node's namespace, or `~x` below the node
/// @param topicType `pkg/Name`
/// @param topicCallback a function, or the name of a global one
/// @param queueSize messages that wait; the newest stay. 0: up to 10000
/// @param transportHints a table; `transports` has to contain `tcp` if it is there
/// @return subscriberHandle it ends with the script
#[api("simROS.subscribe")]
fn subscribe(
    cx: &mut Cx,
    topic_name: String,
    topic_type: String,
    topic_callback: ScriptFunction,
    #[default(1)] queue_size: i64,
    #[default(Data::Nil)] transport_hints: Data,
) -> Result<String> {
    check_hints(&transport_hints)?;
    let subscription = Subscription::new(cx, &topic_name, &topic_type, topic_callback, queue_size)?;
    Ok(add(cx, Entity::Subscription(Rc::new(subscription))))
}

fn check_hints(hints: &Data) -> Result<()> {
    let wrong = |problem: &str| Err(ApiError::Other(format!("transportHints: {problem}")));
    match hints {
        Data::Nil => Ok(()),
        Data::Map(_) | Data::Array(_) => match hints.field("transports") {
            Some(Data::Array(transports))
                if !transports.is_empty() && !transports.contains(&Data::text("tcp")) =>
            {
                wrong("only the transport 'tcp' is supported")
            }
            _ => Ok(()),
        },
        _ => wrong("expected a table"),
    }
}

/// Ends a subscriber.
///
/// @param subscriberHandle the subscriber
#[api("simROS.shutdownSubscriber")]
fn shutdown_subscriber(cx: &mut Cx, subscriber_handle: String) -> Result<()> {
    shut_down(cx, &subscriber_handle, subscription)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param subscriberHandle the subscriber
#[api("simROS.subscriberTreatUInt8ArrayAsString")]
fn subscriber_treat_u_int8_array_as_string(cx: &mut Cx, subscriber_handle: String) -> Result<()> {
    get(cx, &subscriber_handle, subscription)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}

/// Publishes a transform at `/tf`.
///
/// @param transform a `geometry_msgs/TransformStamped`
#[api("simROS.sendTransform")]
fn send_transform(cx: &mut Cx, transform: Table) -> Result<()> {
    broadcast(cx, vec![transform.0])
}

/// Publishes transforms at `/tf`, in one message.
///
/// @param transforms a list of `geometry_msgs/TransformStamped`
#[api("simROS.sendTransforms")]
fn send_transforms(cx: &mut Cx, transforms: Table) -> Result<()> {
    match transforms.0 {
        Data::Array(transforms) => broadcast(cx, transforms),
        Data::Map(entries) if entries.is_empty() => broadcast(cx, Vec::new()),
        _ => Err(ApiError::Other("expected an array of transforms".into())),
    }
}

fn broadcast(cx: &Cx, transforms: Vec<Data>) -> Result<()> {
    broadcaster(cx)?.publish(&Data::map([("transforms", Data::Array(transforms))]))
}

/// The publisher of `/tf`, which the first transform makes.
fn broadcaster(cx: &Cx) -> Result<Rc<Publisher>> {
    let node = node(cx);
    if let Some(broadcaster) = node.broadcaster.borrow().as_ref() {
        return Ok(broadcaster.clone());
    }
    let broadcaster = Rc::new(Publisher::new(cx, "/tf", "tf2_msgs/TFMessage", 100, false)?);
    *node.broadcaster.borrow_mut() = Some(broadcaster.clone());
    Ok(broadcaster)
}
