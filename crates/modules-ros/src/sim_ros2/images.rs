//! Images: topics of `sensor_msgs/msg/Image`, as `image_transport` has them without compression.
//!
//! Pictures of vision sensors have their lowest row first, those of ROS their highest one: rows change places both ways.

use std::cell::Cell;
use std::rc::Rc;

use api_macro::api;
use rtps::{History, Qos};

use super::node::{Entity, add, get, running, shut_down};
use super::ros_values::Style;
use super::times;
use super::topics::{Publisher, Subscription};
use super::{ApiFn, Cx, Result, functions, interfaces};
use crate::ros_images;
pub(super) use crate::ros_images::arguments;
use script::{Bytes, ScriptCallback, ScriptFunction};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    image_transport_create_publisher,
    image_transport_publish,
    image_transport_shutdown_publisher,
    image_transport_create_subscription,
    image_transport_shutdown_subscription,
];

const IMAGE: &str = "sensor_msgs/msg/Image";

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

fn profile(queue_size: i64) -> Qos {
    Qos {
        history: History::KeepLast(usize::try_from(queue_size).unwrap_or(1).max(1)),
        ..Qos::default()
    }
}

/// Creates a publisher of images.
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
    let layout = interfaces::message(cx, IMAGE)?;
    let endpoint = running(cx)?.publisher(&topic_name, &layout, profile(queue_size))?;
    let style = Cell::new(Style {
        bytes_as_strings: true,
    });
    let publisher = Publisher {
        layout,
        endpoint,
        style,
        is_image: true,
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
    let publisher = get(cx, &publisher_handle, publisher)?;
    let stamp = times::to_data(times::ros_time(cx.permissions().tape()));
    publisher.publish(&ros_images::message(
        &data.0, width, height, stamp, &frame_id,
    )?)
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
/// @param topicName as in simROS2.createPublisher
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
    let layout = interfaces::message(cx, IMAGE)?;
    let endpoint = running(cx)?.subscription(&topic_name, &layout, profile(queue_size))?;
    let callback = ScriptCallback::new(cx, topic_callback);
    let (style, has_warned) = (Cell::default(), Cell::default());
    let subscription = Subscription {
        layout,
        endpoint,
        style,
        callback,
        is_image: true,
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
