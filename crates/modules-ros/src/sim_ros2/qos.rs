//! The tables by which scripts state a quality of service.

use std::time::Duration;

use rtps::{Durability, History, Liveliness, Qos, Reliability};

use super::{ApiError, Result};
use scene::Data;
use scene::numbers;

/// The default profile, with what a table states; nil for the profile itself.
///
/// # Errors
/// A table with a value that is none.
pub(super) fn from_data(data: &Data) -> Result<Qos> {
    let default = Qos::default();
    if *data == Data::Nil {
        return Ok(default);
    }
    let depth = usize::try_from(integer(data, "depth", 10)?.max(0)).unwrap_or(0);
    // A depth of zero is the system's default.
    let depth = if depth == 0 { 1 } else { depth };
    Ok(Qos {
        history: match integer(data, "history", 12301)? {
            12300 | 12301 => History::KeepLast(depth),
            12302 => History::KeepAll,
            _ => return Err(unknown("history")),
        },
        reliability: match integer(data, "reliability", 12400)? {
            12400 | 12401 => Reliability::Reliable,
            12402 => Reliability::BestEffort,
            _ => return Err(unknown("reliability")),
        },
        durability: match integer(data, "durability", 12500)? {
            12500 | 12502 => Durability::Volatile,
            12501 => Durability::TransientLocal,
            _ => return Err(unknown("durability")),
        },
        liveliness: match integer(data, "liveliness", 12600)? {
            12600 | 12601 => Liveliness::Automatic,
            12602 => Liveliness::ManualByTopic,
            _ => return Err(unknown("liveliness")),
        },
        deadline: duration(data, "deadline")?,
        lifespan: duration(data, "lifespan")?,
        liveliness_lease: duration(data, "liveliness_lease_duration")?,
    })
}

/// Whether names are used as they are.
///
/// # Errors
/// When it is no boolean.
pub(super) fn avoids_ros_names(data: &Data) -> Result<bool> {
    match data.field("avoid_ros_namespace_conventions") {
        None | Some(Data::Nil) => Ok(false),
        Some(Data::Bool(value)) => Ok(*value),
        Some(_) => Err(unknown("avoid_ros_namespace_conventions")),
    }
}

fn integer(data: &Data, name: &str, default: i64) -> Result<i64> {
    match data.field(name) {
        None | Some(Data::Nil) => Ok(default),
        Some(Data::Int(value)) => Ok(*value),
        Some(Data::Float(value)) => Ok(numbers::truncated(*value)),
        Some(_) => Err(unknown(name)),
    }
}

/// Zero is without end, as in ROS.
fn duration(data: &Data, name: &str) -> Result<Option<Duration>> {
    match data.field(name) {
        None | Some(Data::Nil) => Ok(None),
        Some(table @ (Data::Map(_) | Data::Array(_))) => {
            let seconds = u64::try_from(integer(table, "sec", 0)?).map_err(|_| unknown(name))?;
            let nanoseconds =
                u32::try_from(integer(table, "nanosec", 0)?).map_err(|_| unknown(name))?;
            let whole =
                Duration::from_secs(seconds).checked_add(Duration::from_nanos(nanoseconds.into()));
            Ok(whole.filter(|duration| !duration.is_zero()))
        }
        Some(_) => Err(unknown(name)),
    }
}

fn unknown(name: &str) -> ApiError {
    ApiError::Other(format!("qos: invalid value of '{name}'"))
}
