//! Lock step: a step of the simulation is over when nodes have answered what it published.
//!
//! An answer is a message of a topic that a script subscribes to: one whose header has the time of the step or a later one, or any message of a type
//! without a header. It stays in the queue: callbacks run at the start of the next iteration, in the order in which subscriptions were created, whatever
//! the order in which answers have come. So a run is the same each time.

use std::time::Duration;

use api_macro::api;
use ros_interfaces::Element;

use super::node::{Entity, Node, Running, node, running};
use super::topics::Subscription;
use super::{ApiFn, Cx, Result, functions, names};

pub(super) const FUNCTIONS: &[ApiFn] = functions![await_answers, await_publishers];

/// Bytes before the data: the kind of encoding, of which the lowest bit of the second says whether numbers are little-endian.
const ENCAPSULATION: usize = 4;
/// The type of a field with a time.
const HEADER: &str = "std_msgs/msg/Header";
const NANOSECONDS: f64 = 1e-9;
/// Seconds by which the time of an answer may lie before that of the step: nodes round.
const TOLERANCE: f64 = 1e-6;

/// Waits until something holds for each topic. Returns those for which it did not within `timeout` seconds.
fn await_all(
    cx: &Cx,
    topics: &[String],
    timeout: f64,
    holds: impl Fn(&Subscription) -> bool,
) -> Result<Vec<String>> {
    let (running, node) = (running(cx)?, node(cx));
    let is_late = |topic: &&String| {
        let (mut count, mut all_hold) = (0, true);
        node.entities.for_each(|entity| match entity {
            Entity::Subscription(subscription) if is_of(&node, &running, &subscription, topic) => {
                count += 1;
                all_hold &= holds(&subscription);
            }
            _ => {}
        });
        count == 0 || !all_hold
    };
    let late = || {
        topics
            .iter()
            .filter(is_late)
            .cloned()
            .collect::<Vec<String>>()
    };
    let limit = Duration::try_from_secs_f64(timeout).unwrap_or_default();
    let tape = &running.tape;
    let now = || {
        tape.input("which nodes of ROS 2 have not answered", late)
            .unwrap_or_default()
    };
    let are_all_there = cx.wait_for(Some(limit), || now().is_empty().then_some(()))?;
    Ok(are_all_there.map_or_else(now, |()| Vec::new()))
}

/// Whether a subscription is one of that topic, or of one that the node of that name publishes.
fn is_of(node: &Node, running: &Running, subscription: &Subscription, name: &str) -> bool {
    let Ok(full) = running.resolve(name) else {
        return false;
    };
    let endpoint = &subscription.endpoint;
    if names::topic(&full) == endpoint.topic {
        return true;
    }
    let graph = node.graph.borrow();
    let writers = graph.as_ref().map(|graph| graph.writers_of(&full));
    writers.is_some_and(|writers| endpoint.reads_any(&writers))
}

/// Whether the newest message that waits answers a step of that time.
fn answers(subscription: &Subscription, stamp: f64) -> bool {
    let first = subscription.layout.fields.first();
    let has_header = first.is_some_and(|field| match &field.field_type.element {
        Element::Nested(layout) => layout.name.to_string() == HEADER,
        _ => false,
    });
    let is_recent =
        |payload: &[u8]| stamp_of(payload).is_some_and(|found| found >= stamp - TOLERANCE);
    let endpoint = &subscription.endpoint;
    endpoint.has_newest(|payload| !has_header || is_recent(payload))
}

/// The time in seconds at the start of a message with a header.
fn stamp_of(payload: &[u8]) -> Option<f64> {
    let is_little = payload.get(1)? & 1 == 1;
    let number = |at: usize| {
        let bytes = payload.get(at..at + 4)?.try_into().ok()?;
        Some(if is_little {
            u32::from_le_bytes(bytes)
        } else {
            u32::from_be_bytes(bytes)
        })
    };
    let (seconds, nanoseconds) = (number(ENCAPSULATION)?, number(ENCAPSULATION + 4)?);
    Some(f64::from(seconds.cast_signed()) + f64::from(nanoseconds) * NANOSECONDS)
}

/// Waits until each of the topics has an answer to the step of that time, for all subscriptions of scripts.
///
/// @param topics names
/// @param stamp time of the step, seconds
/// @param timeout seconds
/// @return late topics without an answer
#[api("remote.ros2.lockstep.awaitAnswers")]
fn await_answers(
    cx: &mut Cx,
    topics: Vec<String>,
    stamp: f64,
    timeout: f64,
) -> Result<Vec<String>> {
    await_all(cx, &topics, timeout, |subscription| {
        answers(subscription, stamp)
    })
}

/// Waits until each of the topics is published by a node that listens to something of this one.
///
/// @param topics names
/// @param timeout seconds
/// @return missing topics without one
#[api("remote.ros2.lockstep.awaitPublishers")]
fn await_publishers(cx: &mut Cx, topics: Vec<String>, timeout: f64) -> Result<Vec<String>> {
    let node = node(cx);
    await_all(cx, &topics, timeout, |subscription| {
        let mut has_responder = false;
        node.entities.for_each(|entity| {
            if let Entity::Publisher(publisher) = entity {
                let mut endpoints = publisher.endpoints();
                has_responder |= endpoints.any(|own| own.has_responder(&subscription.endpoint));
            }
        });
        has_responder
    })
}
