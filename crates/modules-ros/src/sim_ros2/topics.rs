//! Topics: publishers, subscriptions, transforms.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use api_macro::api;
use ros_interfaces::{Layout, cdr};
use rtps::{History, Qos};

use super::endpoint::Endpoint;
use super::images::CompressedTopic;
use super::node::{self, Entity, add, get, running, shut_down};
use super::ros_values::{self, Style};
use super::{ApiError, ApiFn, Cx, Result, functions, interfaces, qos};
use crate::ros_images::Content;
use scene::Data;
use script::{ScriptCallback, ScriptFunction, Table};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_publisher,
    publish,
    shutdown_publisher,
    publisher_treat_u_int8_array_as_string,
    create_subscription,
    shutdown_subscription,
    subscription_treat_u_int8_array_as_string,
    send_transform,
    send_transforms,
];

/// What writes a topic.
pub(super) struct Publisher {
    pub(super) layout: Arc<Layout>,
    pub(super) endpoint: Endpoint,
    pub(super) style: Cell<Style>,
    /// Of images: the topic with the same ones compressed.
    pub(super) compressed: Option<CompressedTopic>,
}

/// What reads a topic.
pub(super) struct Subscription {
    pub(super) layout: Arc<Layout>,
    pub(super) endpoint: Endpoint,
    pub(super) style: Cell<Style>,
    pub(super) callback: ScriptCallback,
    pub(super) content: Content,
    /// Whether a message that cannot be read was reported.
    pub(super) has_warned: Cell<bool>,
}

impl Subscription {
    /// Calls back for what has arrived.
    pub(super) fn spin(&self) {
        for _ in 0..self.endpoint.waiting() {
            let Some(sample) = self.endpoint.take() else {
                return;
            };
            let args = cdr::decode(&self.layout, &sample.payload)
                .map_err(|error| error.to_string())
                .and_then(|record| self.content.arguments(&record, self.style.get()));
            match args {
                Ok(args) => drop(self.callback.call_logged(&args)),
                Err(problem) if !self.has_warned.replace(true) => {
                    self.callback.warn(&format!(
                        "a message of type {} was left out: {problem}",
                        self.layout.name
                    ));
                }
                Err(_) => {}
            }
        }
    }
}

pub(super) fn publisher(entity: Entity) -> Option<Rc<Publisher>> {
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

/// The name of a topic on the wire.
fn topic(cx: &Cx, name: &str, qos: &Data) -> Result<String> {
    let full = running(cx)?.resolve(name)?;
    Ok(if qos::avoids_ros_names(qos)? {
        full
    } else {
        super::names::topic(&full)
    })
}

/// Creates a publisher.
///
/// @param topicName `/x`, `x` in the node's namespace, or `~/x` below the node
/// @param topicType `pkg/msg/Name`
/// @param unused
/// @param unused2
/// @param qos nil, or a table: history, depth, reliability, durability, deadline, lifespan, liveliness, liveliness_lease_duration, avoid_ros_namespace_conventions
/// @return publisherHandle it ends with the script
#[api("simROS2.createPublisher")]
fn create_publisher(
    cx: &mut Cx,
    topic_name: String,
    topic_type: String,
    #[default(0)] _unused: i64,
    #[default(false)] _unused2: bool,
    #[default(Data::Nil)] qos: Data,
) -> Result<String> {
    let layout = interfaces::message(cx, &topic_type)?;
    let topic = topic(cx, &topic_name, &qos)?;
    let endpoint = Endpoint::writer(&running(cx)?, &topic, &layout, qos::from_data(&qos)?);
    let publisher = Publisher {
        layout,
        endpoint,
        style: Cell::default(),
        compressed: None,
    };
    Ok(add(cx, Entity::Publisher(Rc::new(publisher))))
}

/// Publishes a message. Fields that are not there have their default.
///
/// @param publisherHandle the publisher
/// @param message a table with the fields of the type
#[api("simROS2.publish")]
fn publish(cx: &mut Cx, publisher_handle: String, message: Table) -> Result<()> {
    let publisher = get(cx, &publisher_handle, publisher)?;
    publisher.publish(&message.0)
}

impl Publisher {
    pub(super) fn publish(&self, message: &Data) -> Result<()> {
        let record = ros_values::from_data(&self.layout, message, self.style.get())
            .map_err(ApiError::Other)?;
        self.endpoint.publish(&record);
        Ok(())
    }

    /// Its writers: of images there are two.
    pub(super) fn endpoints(&self) -> impl Iterator<Item = &Endpoint> {
        let compressed = self.compressed.iter().map(|topic| &topic.endpoint);
        [&self.endpoint].into_iter().chain(compressed)
    }
}

/// Ends a publisher.
///
/// @param publisherHandle the publisher
#[api("simROS2.shutdownPublisher")]
fn shutdown_publisher(cx: &mut Cx, publisher_handle: String) -> Result<()> {
    shut_down(cx, &publisher_handle, publisher)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param publisherHandle the publisher
#[api("simROS2.publisherTreatUInt8ArrayAsString")]
fn publisher_treat_u_int8_array_as_string(cx: &mut Cx, publisher_handle: String) -> Result<()> {
    get(cx, &publisher_handle, publisher)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}

/// Creates a subscription. The callback gets the message as a table, at the start of an iteration of the loop.
///
/// @param topicName `/x`, `x` in the node's namespace, or `~/x` below the node
/// @param topicType `pkg/msg/Name`
/// @param topicCallback a function, or the name of a global one
/// @param unused
/// @param qos as in simROS2.createPublisher; the newest `depth` messages wait
/// @return subscriptionHandle it ends with the script
#[api("simROS2.createSubscription")]
fn create_subscription(
    cx: &mut Cx,
    topic_name: String,
    topic_type: String,
    topic_callback: ScriptFunction,
    #[default(0)] _unused: i64,
    #[default(Data::Nil)] qos: Data,
) -> Result<String> {
    let layout = interfaces::message(cx, &topic_type)?;
    let topic = topic(cx, &topic_name, &qos)?;
    let endpoint = Endpoint::reader(&running(cx)?, &topic, &layout, qos::from_data(&qos)?);
    let callback = ScriptCallback::new(cx, topic_callback);
    let (style, has_warned) = (Cell::default(), Cell::default());
    let subscription = Subscription {
        layout,
        endpoint,
        style,
        callback,
        content: Content::Message,
        has_warned,
    };
    Ok(add(cx, Entity::Subscription(Rc::new(subscription))))
}

/// Ends a subscription.
///
/// @param subscriptionHandle the subscription
#[api("simROS2.shutdownSubscription")]
fn shutdown_subscription(cx: &mut Cx, subscription_handle: String) -> Result<()> {
    shut_down(cx, &subscription_handle, subscription)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param subscriptionHandle the subscription
#[api("simROS2.subscriptionTreatUInt8ArrayAsString")]
fn subscription_treat_u_int8_array_as_string(
    cx: &mut Cx,
    subscription_handle: String,
) -> Result<()> {
    get(cx, &subscription_handle, subscription)?
        .style
        .set(Style {
            bytes_as_strings: true,
        });
    Ok(())
}

/// Publishes a transform at `/tf`.
///
/// @param transform a `geometry_msgs/msg/TransformStamped`
#[api("simROS2.sendTransform")]
fn send_transform(cx: &mut Cx, transform: Table) -> Result<()> {
    broadcast(cx, vec![transform.0])
}

/// Publishes transforms at `/tf`, in one message.
///
/// @param transforms a list of `geometry_msgs/msg/TransformStamped`
#[api("simROS2.sendTransforms")]
fn send_transforms(cx: &mut Cx, transforms: Table) -> Result<()> {
    match transforms.0 {
        Data::Array(transforms) => broadcast(cx, transforms),
        Data::Map(entries) if entries.is_empty() => broadcast(cx, Vec::new()),
        _ => Err(ApiError::Other("expected an array of transforms".into())),
    }
}

fn broadcast(cx: &Cx, transforms: Vec<Data>) -> Result<()> {
    let broadcaster = broadcaster(cx)?;
    broadcaster.publish(&Data::map([("transforms", Data::Array(transforms))]))
}

/// The publisher of `/tf`, which the first transform makes.
fn broadcaster(cx: &Cx) -> Result<Rc<Publisher>> {
    let node = node::node(cx);
    if let Some(broadcaster) = node.broadcaster.borrow().as_ref() {
        return Ok(broadcaster.clone());
    }
    let layout = interfaces::message(cx, "tf2_msgs/msg/TFMessage")?;
    let qos = Qos {
        history: History::KeepLast(100),
        ..Qos::default()
    };
    let endpoint = running(cx)?.publisher("/tf", &layout, qos)?;
    let broadcaster = Rc::new(Publisher {
        layout,
        endpoint,
        style: Cell::default(),
        compressed: None,
    });
    *node.broadcaster.borrow_mut() = Some(broadcaster.clone());
    Ok(broadcaster)
}
