//! What the add-on of `--ros2` needs for robots (`lua/library/remote/ros2/robots.lua`): their description, pictures as messages have them, rays.

mod clouds;
mod description;
mod rays;

use api_macro::api;

use super::node::{Entity, get};
use super::{ApiError, ApiFn, Cx, Result, functions, images};

/// Internal functions.
pub(super) const FUNCTIONS: [&[ApiFn]; 5] = [
    functions![has_readers],
    description::FUNCTIONS,
    clouds::FUNCTIONS,
    images::OF_ROBOTS,
    rays::FUNCTIONS,
];

/// Whether anything reads what a publisher publishes.
///
/// @param publisherHandle the publisher
/// @return hasReaders
#[api("remote.ros2.robots.hasReaders")]
fn has_readers(cx: &Cx, publisher_handle: String) -> Result<bool> {
    let publisher = get(cx, &publisher_handle, |entity| match entity {
        Entity::Publisher(publisher) => Some(publisher),
        _ => None,
    })?;
    let compressed = publisher.compressed.as_ref();
    Ok(publisher.endpoint.has_reader()
        || compressed.is_some_and(|topic| topic.endpoint.has_reader()))
}

/// The 32-bit floats of bytes.
fn floats(bytes: &[u8]) -> impl DoubleEndedIterator<Item = f32> + ExactSizeIterator + '_ {
    bytes
        .as_chunks::<4>()
        .0
        .iter()
        .map(|bytes| f32::from_le_bytes(*bytes))
}

/// A number of columns, rows or rays.
fn count(number: i64) -> Result<usize> {
    const MOST: usize = 1 << 22;
    let count = usize::try_from(number)
        .ok()
        .filter(|count| (1..=MOST).contains(count));
    count.ok_or_else(|| ApiError::Other(format!("invalid number of pixels: {number}")))
}

/// Fails if there are not so many bytes.
fn check_length(what: &str, bytes: &[u8], needed: Option<usize>) -> Result<()> {
    if Some(bytes.len()) == needed {
        return Ok(());
    }
    Err(ApiError::Other(format!(
        "the {what} has {} bytes",
        bytes.len()
    )))
}
