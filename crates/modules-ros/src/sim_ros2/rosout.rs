//! The log of the node at `/rosout`, where nodes of ROS 2 publish theirs (`ros2 topic echo /rosout`).

use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use api_macro::api;
use ros_interfaces::Layout;
use rtps::{Durability, History, Qos};

use super::endpoint::Endpoint;
use super::node::{Running, node};
use super::ros_values::{self, Style};
use super::{ApiError, ApiFn, Cx, Result, functions, names, times};
use scene::Data;

pub(super) const FUNCTIONS: &[ApiFn] = functions![publish_log];

/// The type of its messages.
pub(super) const TYPE: &str = "rcl_interfaces/msg/Log";
/// As DDS calls the topic.
const TOPIC: &str = "/rosout";
/// Lines that late readers get, and how long (as rcl has it).
const DEPTH: usize = 1000;
const LIFESPAN: Duration = Duration::from_secs(10);

/// What publishes the log.
pub(super) struct RosOut {
    layout: Arc<Layout>,
    endpoint: Endpoint,
}

impl RosOut {
    pub(super) fn new(running: &Rc<Running>, layout: Arc<Layout>) -> Self {
        let qos = Qos {
            durability: Durability::TransientLocal,
            history: History::KeepLast(DEPTH),
            lifespan: Some(LIFESPAN),
            ..Qos::default()
        };
        Self {
            endpoint: Endpoint::writer(running, &names::topic(TOPIC), &layout, qos),
            layout,
        }
    }
}

/// Publishes a line of the log, if there is a node.
///
/// @param level 10 debug, 20 info, 30 warning, 40 error
/// @param text the line
#[api("simROS2._publishLog")]
fn publish_log(cx: &mut Cx, level: i64, text: String) -> Result<()> {
    let rosout = node(cx).rosout.borrow().clone();
    let Some(rosout) = rosout.filter(|_| !text.is_empty()) else {
        return Ok(());
    };
    let stamp = times::to_data(times::ros_time(cx.permissions().tape()));
    let line = Data::map([
        ("stamp", stamp),
        ("level", Data::Int(level)),
        ("name", Data::text(&rosout.endpoint.node.place.node)),
        ("msg", Data::text(&text)),
    ]);
    let line = ros_values::from_data(&rosout.layout, &line, Style::default());
    rosout.endpoint.publish(&line.map_err(ApiError::Other)?);
    Ok(())
}
