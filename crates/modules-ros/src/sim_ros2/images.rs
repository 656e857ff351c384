//! Images: topics of `sensor_msgs/msg/Image`, and of `sensor_msgs/msg/CompressedImage` beside them, as `image_transport` has them.
//!
//! Pictures of vision sensors have their lowest row first, those of ROS their highest one: rows change places both ways.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use api_macro::api;
use ros_interfaces::Layout;
use rtps::{History, Qos};

use super::endpoint::Endpoint;
use super::node::{Entity, Node, add, get, node, running, shut_down};
use super::parameters::Parameter;
use super::ros_values::{self, Style};
use super::times;
use super::topics::{Publisher, Subscription};
use super::{ApiError, ApiFn, Cx, Result, functions, interfaces};
use crate::ros_compressed::Compression;
use crate::ros_images::{COMPRESSED, Content, Frame};
use scene::Data;
use script::{Bytes, ScriptCallback, ScriptFunction, Table};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    image_transport_create_publisher,
    image_transport_publish,
    image_transport_shutdown_publisher,
    image_transport_create_subscription,
    image_transport_shutdown_subscription,
];

/// What robots publish images by.
pub(super) const OF_ROBOTS: &[ApiFn] = functions![publish_image];

const IMAGE: &str = "sensor_msgs/msg/Image";
const COMPRESSED_IMAGE: &str = "sensor_msgs/msg/CompressedImage";
/// The quality of JPEG that nobody has chosen, as in `compressed_image_transport`.
const QUALITY: i64 = 95;
const BYTES: Style = Style {
    bytes_as_strings: true,
};

/// Where the images of a topic are published compressed.
pub(super) struct CompressedTopic {
    layout: Arc<Layout>,
    pub(super) endpoint: Endpoint,
    /// How the names of its parameters begin.
    parameters: String,
}

impl CompressedTopic {
    fn new(cx: &Cx, topic: &str, qos: Qos) -> Result<Self> {
        let (running, layout) = (running(cx)?, interfaces::message(cx, COMPRESSED_IMAGE)?);
        let full = running.resolve(topic)?;
        let namespace = &running.place.namespace;
        let below = full.strip_prefix(namespace.as_str()).unwrap_or(&full);
        let topic = format!("{topic}{COMPRESSED}");
        Ok(Self {
            endpoint: running.publisher(&topic, &layout, qos)?,
            layout,
            parameters: format!("{}.compressed.", below[1..].replace('/', ".")),
        })
    }

    /// Publishes an image if somebody reads it: compression takes long.
    fn publish(&self, node: &Node, frame: &Frame, stamp: &Data, frame_id: &str) -> Result<()> {
        if self.endpoint.matched() == 0 {
            return Ok(());
        }
        let message = frame.compressed(self.compression(node)?, stamp.clone(), frame_id)?;
        let record = ros_values::from_data(&self.layout, &message, BYTES);
        self.endpoint.publish(&record.map_err(ApiError::Other)?);
        Ok(())
    }

    /// As the parameters of the node say.
    fn compression(&self, node: &Node) -> Result<Compression> {
        let parameters = node.parameters.borrow();
        let parameter = |name: &str| parameters.get(&format!("{}{name}", self.parameters));
        let format = match parameter("format") {
            Some(Parameter::String(format)) => format.as_str(),
            _ => "jpeg",
        };
        let quality = match parameter("jpeg_quality") {
            Some(Parameter::Int(quality)) => *quality,
            _ => QUALITY,
        };
        Compression::new(format, quality)
    }
}

fn publisher(entity: Entity) -> Option<Rc<Publisher>> {
    match entity {
        Entity::Publisher(publisher) if publisher.compressed.is_some() => Some(publisher),
        _ => None,
    }
}

fn subscription(entity: Entity) -> Option<Rc<Subscription>> {
    match entity {
        Entity::Subscription(subscription) if subscription.content.is_image() => Some(subscription),
        _ => None,
    }
}

fn profile(queue_size: i64) -> Qos {
    Qos {
        history: History::KeepLast(usize::try_from(queue_size).unwrap_or(1).max(1)),
        ..Qos::default()
    }
}

/// Creates a publisher of images. Who subscribes to the topic's name with `/compressed` behind it gets them as
/// `sensor_msgs/msg/CompressedImage`: JPEG, or as the parameters `TOPIC.compressed.format` ('jpeg', 'png') and `TOPIC.compressed.jpeg_quality`
/// (1 to 100) of the node say, where dots stand for the slashes of the topic.
///
/// @param topicName as in simROS2.createPublisher
/// @param queueSize how many images are kept
/// @return publisherHandle it ends with the script
#[api("simROS2.imageTransportCreatePublisher")]
fn image_transport_create_publisher(
    cx: &mut Cx,
    topic_name: String,
    #[default(1)] queue_size: i64,
) -> Result<String> {
    let (layout, qos) = (interfaces::message(cx, IMAGE)?, profile(queue_size));
    let publisher = Publisher {
        endpoint: running(cx)?.publisher(&topic_name, &layout, qos)?,
        layout,
        style: Cell::new(BYTES),
        compressed: Some(CompressedTopic::new(cx, &topic_name, qos)?),
    };
    Ok(add(cx, Entity::Publisher(Rc::new(publisher))))
}

/// Publishes an image with three bytes per pixel, the lowest row first, as vision sensors have it.
///
/// @param publisherHandle the publisher
/// @param data width * height * 3 bytes, RGB
/// @param width pixels
/// @param height pixels
/// @param frame_id of the header
#[api("simROS2.imageTransportPublish")]
fn image_transport_publish(
    cx: &mut Cx,
    publisher_handle: String,
    data: Bytes,
    width: i64,
    height: i64,
    #[name("frame_id")] frame_id: String,
) -> Result<()> {
    let stamp = times::to_data(times::ros_time(cx.permissions().tape()));
    let frame = Frame::new(&data.0, width, height)?;
    publish(cx, &publisher_handle, frame, stamp, &frame_id)
}

/// Publishes an image as it is, and compressed.
fn publish(
    cx: &Cx,
    publisher_handle: &str,
    frame: Frame,
    stamp: Data,
    frame_id: &str,
) -> Result<()> {
    let publisher = get(cx, publisher_handle, publisher)?;
    if let Some(topic) = &publisher.compressed {
        topic.publish(&node(cx), &frame, &stamp, frame_id)?;
    }
    publisher.publish(&frame.message(stamp, frame_id))
}

/// Publishes an image that was taken at a time.
///
/// @param publisherHandle the publisher
/// @param data width * height * 3 bytes, RGB
/// @param width pixels
/// @param frame_id of the header
/// @param stamp of the header
#[api("remote.ros2.robots.publishImage")]
fn publish_image(
    cx: &mut Cx,
    publisher_handle: String,
    data: Bytes,
    width: i64,
    #[name("frame_id")] frame_id: String,
    stamp: Table,
) -> Result<()> {
    let row = width.saturating_mul(3).max(1);
    let height = scene::numbers::count(data.0.len()) / row;
    let frame = Frame::new(&data.0, width, height)?;
    publish(cx, &publisher_handle, frame, stamp.0, &frame_id)
}

/// Ends a publisher of images.
///
/// @param publisherHandle the publisher
#[api("simROS2.imageTransportShutdownPublisher")]
fn image_transport_shutdown_publisher(cx: &mut Cx, publisher_handle: String) -> Result<()> {
    shut_down(cx, &publisher_handle, publisher)
}

/// Creates a subscription of images. The callback gets data, width and height: three bytes per pixel, RGB, the lowest row first.
///
/// @param topicName as in simROS2.createPublisher; with `/compressed` at its end, images come compressed (JPEG or PNG)
/// @param topicCallback a function, or the name of a global one
/// @param queueSize how many images wait
/// @return subscriptionHandle it ends with the script
#[api("simROS2.imageTransportCreateSubscription")]
fn image_transport_create_subscription(
    cx: &mut Cx,
    topic_name: String,
    topic_callback: ScriptFunction,
    #[default(1)] queue_size: i64,
) -> Result<String> {
    let content = Content::of_images(&topic_name);
    let kind = match content {
        Content::CompressedImage => COMPRESSED_IMAGE,
        Content::Image | Content::Message => IMAGE,
    };
    let layout = interfaces::message(cx, kind)?;
    let endpoint = running(cx)?.subscription(&topic_name, &layout, profile(queue_size))?;
    let callback = ScriptCallback::new(cx, topic_callback);
    let (style, has_warned) = (Cell::default(), Cell::default());
    let subscription = Subscription {
        layout,
        endpoint,
        style,
        callback,
        content,
        has_warned,
    };
    Ok(add(cx, Entity::Subscription(Rc::new(subscription))))
}

/// Ends a subscription of images.
///
/// @param subscriptionHandle the subscription
#[api("simROS2.imageTransportShutdownSubscription")]
fn image_transport_shutdown_subscription(cx: &mut Cx, subscription_handle: String) -> Result<()> {
    shut_down(cx, &subscription_handle, subscription)
}
