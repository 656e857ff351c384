//! Images: topics of `sensor_msgs/Image`, and of `sensor_msgs/CompressedImage` beside them, as `image_transport` has them.

use std::rc::Rc;

use api_macro::api;

use super::network::Parameter;
use super::node::{Entity, add, get, node, running, shut_down};
use super::topics::{Publisher, Subscription};
use super::{ApiFn, Cx, Result, failed, functions};
use crate::ros_compressed::Compression;
use crate::ros_images::{COMPRESSED, Content, Frame};
use scene::Data;
use script::{Bytes, ScriptFunction};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    image_transport_advertise,
    image_transport_publish,
    image_transport_shutdown_publisher,
    image_transport_subscribe,
    image_transport_shutdown_subscriber,
];

const IMAGE: &str = "sensor_msgs/Image";
const COMPRESSED_IMAGE: &str = "sensor_msgs/CompressedImage";
/// The quality of JPEG that nobody has chosen, as in `compressed_image_transport`.
const QUALITY: i32 = 80;

/// Where the images of a topic are published compressed.
pub(super) struct CompressedTopic {
    publisher: Box<Publisher>,
    compression: Compression,
}

impl CompressedTopic {
    fn new(cx: &Cx, topic: &str, queue_size: i64) -> Result<Self> {
        let topic = format!("{topic}{COMPRESSED}");
        let publisher = Publisher::new(cx, &topic, COMPRESSED_IMAGE, queue_size, false)?;
        Ok(Self {
            publisher: Box::new(publisher.of_images(None)),
            compression: compression(cx, &topic)?,
        })
    }

    /// Publishes an image if somebody subscribes: compression takes long.
    fn publish(&self, frame: &Frame, stamp: &Data, frame_id: &str) -> Result<()> {
        if self.publisher.subscribers() == 0 {
            return Ok(());
        }
        let message = frame.compressed(self.compression, stamp.clone(), frame_id)?;
        self.publisher.publish(&message)
    }
}

/// As the parameters below the topic say.
fn compression(cx: &Cx, topic: &str) -> Result<Compression> {
    let running = running(cx)?;
    let parameter = |name: &str| running.node.parameter(&format!("{topic}/{name}"));
    let format = match parameter("format").map_err(|error| failed(&error))? {
        Some(Parameter::Text(format)) => format,
        _ => "jpeg".to_owned(),
    };
    let quality = match parameter("jpeg_quality").map_err(|error| failed(&error))? {
        Some(Parameter::Int(quality)) => quality,
        _ => QUALITY,
    };
    Compression::new(&format, quality.into())
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

/// Publishes a topic of images. Who subscribes to the topic's name with `/compressed` behind it gets them as `sensor_msgs/CompressedImage`:
/// JPEG, or as the parameters `TOPIC/compressed/format` ('jpeg', 'png') and `TOPIC/compressed/jpeg_quality` (1 to 100) say when this is called.
///
/// @param topicName as in simROS.advertise
/// @param queueSize images that wait for a slow subscriber; then the newest stay
/// @return publisherHandle it ends with the script
#[api("simROS.imageTransportAdvertise")]
fn image_transport_advertise(
    cx: &mut Cx,
    topic_name: String,
    #[default(1)] queue_size: i64,
) -> Result<String> {
    let publisher = Publisher::new(cx, &topic_name, IMAGE, queue_size, false)?;
    let compressed = CompressedTopic::new(cx, &topic_name, queue_size)?;
    let publisher = publisher.of_images(Some(compressed));
    Ok(add(cx, Entity::Publisher(Rc::new(publisher))))
}

/// Publishes an image with three bytes per pixel, the lowest row first, as vision sensors have it.
///
/// @param publisherHandle the publisher
/// @param data width * height * 3 bytes, RGB
/// @param width pixels
/// @param height pixels
/// @param frame_id of the header
#[api("simROS.imageTransportPublish")]
fn image_transport_publish(
    cx: &mut Cx,
    publisher_handle: String,
    data: Bytes,
    width: i64,
    height: i64,
    #[name("frame_id")] frame_id: String,
) -> Result<()> {
    let publisher = get(cx, &publisher_handle, publisher)?;
    let stamp = Data::Float(node(cx).time(cx.permissions().tape()));
    let frame = Frame::new(&data.0, width, height)?;
    if let Some(topic) = &publisher.compressed {
        topic.publish(&frame, &stamp, &frame_id)?;
    }
    publisher.publish(&frame.message(stamp, &frame_id))
}

/// Ends a publisher of images.
///
/// @param publisherHandle the publisher
#[api("simROS.imageTransportShutdownPublisher")]
fn image_transport_shutdown_publisher(cx: &mut Cx, publisher_handle: String) -> Result<()> {
    shut_down(cx, &publisher_handle, publisher)
}

/// Subscribes to a topic of images. The callback gets data, width and height: three bytes per pixel, RGB, the lowest row first.
///
/// @param topicName as in simROS.subscribe; with `/compressed` at its end, images come compressed (JPEG or PNG)
/// @param topicCallback a function, or the name of a global one
/// @param queueSize images that wait; the newest stay
/// @return subscriberHandle it ends with the script
#[api("simROS.imageTransportSubscribe")]
fn image_transport_subscribe(
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
    let subscription = Subscription::new(cx, &topic_name, kind, topic_callback, queue_size)?;
    let subscription = subscription.of_images(content);
    Ok(add(cx, Entity::Subscription(Rc::new(subscription))))
}

/// Ends a subscriber of images.
///
/// @param subscriberHandle the subscriber
#[api("simROS.imageTransportShutdownSubscriber")]
fn image_transport_shutdown_subscriber(cx: &mut Cx, subscriber_handle: String) -> Result<()> {
    shut_down(cx, &subscriber_handle, subscription)
}
