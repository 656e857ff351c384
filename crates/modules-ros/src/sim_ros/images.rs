//! Images: topics of `sensor_msgs/Image`, as `image_transport` has them without compression.

use std::rc::Rc;

use api_macro::api;

use super::node::{Entity, add, get, node, shut_down};
use super::topics::{Publisher, Subscription};
use super::{ApiFn, Cx, Result, functions};
use crate::ros_images;
pub(super) use crate::ros_images::arguments;
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

fn publisher(entity: Entity) -> Option<Rc<Publisher>> {
    match entity {
        Entity::Publisher(publisher) if publisher.is_image => Some(publisher),
        _ => None,
    }
}

fn subscription(entity: Entity) -> Option<Rc<Subscription>> {
    match entity {
        Entity::Subscription(subscription) if subscription.is_image => Some(subscription),
        _ => None,
    }
}

/// Publishes a topic of images.
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
    let publisher = Publisher::new(cx, &topic_name, IMAGE, queue_size, false)?.of_images();
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
    publisher.publish(&ros_images::message(
        &data.0, width, height, stamp, &frame_id,
    )?)
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
/// @param topicName as in simROS.subscribe
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
    let subscription =
        Subscription::new(cx, &topic_name, IMAGE, topic_callback, queue_size)?.of_images();
    Ok(add(cx, Entity::Subscription(Rc::new(subscription))))
}

/// Ends a subscriber of images.
///
/// @param subscriberHandle the subscriber
#[api("simROS.imageTransportShutdownSubscriber")]
fn image_transport_shutdown_subscriber(cx: &mut Cx, subscriber_handle: String) -> Result<()> {
    shut_down(cx, &subscriber_handle, subscription)
}
