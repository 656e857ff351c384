//! Images: topics of `sensor_msgs/msg/Image`, as `image_transport` has them without compression.
//!
//! Pictures of vision sensors have their lowest row first, those of ROS their highest one: rows change places both ways.

use std::cell::Cell;
use std::rc::Rc;

use api_macro::api;
use ros_interfaces::{Array, Number, Numbers, Record, Value};
use rtps::{History, Qos};

use super::node::{Entity, add, get, running, shut_down};
use super::ros_values::Style;
use super::times;
use super::topics::{Publisher, Subscription};
use super::{ApiError, ApiFn, Cx, Result, functions, interfaces};
use crate::scene::Data;
use crate::script::{Bytes, ScriptCallback, ScriptFunction};

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
    Qos { history: History::KeepLast(usize::try_from(queue_size).unwrap_or(1).max(1)), ..Qos::default() }
}

/// Creates a publisher of images.
///
/// @param topicName as in simROS2.createPublisher
/// @param queueSize how many images are kept
/// @return publisherHandle it ends with the script
#[api("simROS2.imageTransportCreatePublisher")]
fn image_transport_create_publisher(cx: &mut Cx, topic_name: String, #[default(1)] queue_size: i64) -> Result<String> {
    let layout = interfaces::message(cx, IMAGE)?;
    let endpoint = running(cx)?.publisher(&topic_name, &layout, profile(queue_size))?;
    let style = Cell::new(Style { bytes_as_strings: true });
    let publisher = Publisher { layout, endpoint, style, is_image: true };
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
    frame_id: String,
) -> Result<()> {
    let publisher = get(cx, &publisher_handle, publisher)?;
    let size = |side| u32::try_from(side).ok().filter(|side| (1..=1 << 16).contains(side));
    let (Some(columns), Some(rows)) = (size(width), size(height)) else {
        return Err(ApiError::Other(format!("invalid size of an image: {width} x {height}")));
    };
    let row = columns as usize * 3;
    if data.0.len() != row * rows as usize {
        let needed = row * rows as usize;
        return Err(ApiError::Other(format!("the image has {} bytes, expected {needed}", data.0.len())));
    }
    let flipped: Vec<u8> = data.0.chunks_exact(row).rev().flatten().copied().collect();
    let mut header = vec![("stamp", times::to_data(times::ros_time()))];
    if !frame_id.is_empty() {
        header.push(("frame_id", Data::text(&frame_id)));
    }
    let key = |name: &str| crate::scene::Key::Text(name.as_bytes().to_vec());
    publisher.publish(&Data::map([
        ("header", Data::Map(header.into_iter().map(|(name, value)| (key(name), value)).collect())),
        ("height", Data::Int(rows.into())),
        ("width", Data::Int(columns.into())),
        ("encoding", Data::text("rgb8")),
        ("step", Data::Int(row as i64)),
        ("data", Data::Buffer(flipped)),
    ]))
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
    let subscription = Subscription { layout, endpoint, style, callback, is_image: true, has_warned };
    Ok(add(cx, Entity::Subscription(Rc::new(subscription))))
}

/// Ends a subscription of images.
///
/// @param subscriptionHandle the subscription
#[api("simROS2.imageTransportShutdownSubscription")]
fn image_transport_shutdown_subscription(cx: &mut Cx, subscription_handle: String) -> Result<()> {
    shut_down(cx, &subscription_handle, subscription)
}

/// What a callback gets of a message: RGB data with the lowest row first, width, height.
pub(super) fn arguments(record: &Record) -> std::result::Result<Vec<Data>, String> {
    let (Some(width), Some(height), Some(step)) = (size(record, "width"), size(record, "height"), size(record, "step"))
    else {
        return Err("no image".into());
    };
    let (Some(Value::String(encoding)), Some(Value::Array(Array::Numbers(Numbers::UInt8(data))))) =
        (record.get("encoding"), record.get("data"))
    else {
        return Err("no image".into());
    };
    let channels: &[usize] = match encoding.as_slice() {
        b"rgb8" | b"8UC3" => &[3, 0, 1, 2],
        b"bgr8" => &[3, 2, 1, 0],
        b"rgba8" => &[4, 0, 1, 2],
        b"bgra8" => &[4, 2, 1, 0],
        b"mono8" | b"8UC1" => &[1, 0, 0, 0],
        other => return Err(format!("its encoding '{}' is not supported", String::from_utf8_lossy(other))),
    };
    let row = width * channels[0];
    if step < row || step.checked_mul(height).is_none_or(|size| size > data.len()) || width == 0 || height == 0 {
        return Err("its data do not fit its size".into());
    }
    let mut rgb = Vec::with_capacity(width * height * 3);
    for line in data.chunks_exact(step).take(height).rev() {
        for pixel in line[..row].chunks_exact(channels[0]) {
            rgb.extend(channels[1..].iter().map(|channel| pixel[*channel]));
        }
    }
    Ok(vec![Data::Buffer(rgb), Data::Int(width as i64), Data::Int(height as i64)])
}

fn size(record: &Record, name: &str) -> Option<usize> {
    match record.get(name) {
        Some(Value::Number(Number::UInt32(value))) => Some(*value as usize),
        _ => None,
    }
}
