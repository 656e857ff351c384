//! Recordings as MCAP files with the messages of Foxglove, which Foxglove and Rerun open.
//!
//! The container is written by our own code: the crate `mcap` would bring thirty packages and features of `serde` with which everything else is
//! built anew, for a format of which only writing, and few kinds of records, are needed here.

mod container;
mod objects;
mod proto;
mod schemas;

use std::collections::BTreeMap;
use std::io::{Read, Seek, Write};

use serde_json::Value;

use super::blobs::Hash;
use super::recording::{Content, Recording, RecordingError, messages};
use container::Container;
use objects::Objects;
use proto::Proto;

/// The frame in which all poses are.
const WORLD: &str = "world";
/// Kinds of binary messages.
const POSES: u8 = 1;
const IMAGE: u8 = 2;

/// A channel of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Channel {
    Transforms,
    Scene,
    Joints,
    Log,
    /// Of the vision sensor with that handle.
    Image(i64),
}

/// Writes all of a recording.
///
/// # Errors
/// When it is damaged, or the file cannot be written.
pub fn write<R: Read + Seek, W: Write>(
    recording: &mut Recording<R>,
    out: W,
) -> Result<(), RecordingError> {
    let mut file = File {
        container: Container::new(out)?,
        channels: BTreeMap::new(),
    };
    let mut objects = Objects::default();
    for number in 0..recording.index().chunks.len() {
        let chunk = recording.chunk(number)?;
        for message in messages(&chunk) {
            let message = message?;
            match message.content {
                Content::Blob { hash, bytes } => objects.add_blob(Hash(hash), bytes),
                Content::Text(text) => file.add_text(&mut objects, text, message.time)?,
                Content::Binary(bytes) => file.add_binary(&objects, bytes, message.time)?,
            }
        }
    }
    Ok(file.container.finish()?)
}

struct File<W> {
    container: Container<W>,
    channels: BTreeMap<Channel, u16>,
}

impl<W: Write> File<W> {
    fn add_text(
        &mut self,
        objects: &mut Objects,
        text: &str,
        time: f64,
    ) -> Result<(), RecordingError> {
        let message: Value = serde_json::from_str(text)
            .map_err(|_| RecordingError::Damaged("a message is no JSON"))?;
        let changed = objects.update(&message);
        if let Some(scene) = objects.scene_update(&changed, time) {
            self.add(Channel::Scene, "/scene", scene, time)?;
        }
        if let Some(joints) = objects.joint_states(&changed.handles, time) {
            self.add(Channel::Joints, "/joint_states", joints, time)?;
        }
        for line in message["log"].as_array().into_iter().flatten() {
            self.add(Channel::Log, "/log", log(line), time)?;
        }
        Ok(())
    }

    fn add_binary(
        &mut self,
        objects: &Objects,
        bytes: &[u8],
        time: f64,
    ) -> Result<(), RecordingError> {
        let cut = || RecordingError::Damaged("a message is cut off");
        match bytes.first() {
            Some(&POSES) => {
                let transforms = objects.transforms(bytes, time).ok_or_else(cut)?;
                self.add(Channel::Transforms, "/tf", transforms, time)
            }
            Some(&IMAGE) => {
                let (handle, image) = objects.image(bytes, time).ok_or_else(cut)?;
                let topic = format!("/image{}", objects.frame(handle));
                self.add(Channel::Image(handle), &topic, image, time)
            }
            _ => Ok(()),
        }
    }

    fn add(
        &mut self,
        channel: Channel,
        topic: &str,
        message: Proto,
        time: f64,
    ) -> Result<(), RecordingError> {
        let channel_id = match self.channels.get(&channel) {
            Some(id) => *id,
            None => {
                let schema = match channel {
                    Channel::Transforms => "foxglove.FrameTransforms",
                    Channel::Scene => "foxglove.SceneUpdate",
                    Channel::Joints => "foxglove.JointStates",
                    Channel::Log => "foxglove.Log",
                    Channel::Image(_) => "foxglove.RawImage",
                };
                let id = self
                    .container
                    .add_channel(topic, schema, &schemas::descriptors());
                self.channels.insert(channel, id);
                id
            }
        };
        Ok(self
            .container
            .add(channel_id, nanoseconds(time), &message.into_bytes())?)
    }
}

fn nanoseconds(time: f64) -> u64 {
    (time.max(0.0) * 1e9).round() as u64
}

/// A `google.protobuf.Timestamp` or `Duration`.
fn timestamp(time: f64) -> Proto {
    let time = nanoseconds(time);
    Proto::new()
        .int(1, time / 1_000_000_000)
        .int(2, time % 1_000_000_000)
}

/// A `foxglove.Log`.
fn log(line: &Value) -> Proto {
    let level = match line["level"].as_str().unwrap_or_default() {
        "errors" | "scripterrors" => 4,
        "warnings" | "scriptwarnings" => 3,
        "debug" | "trace" | "tracelua" | "traceall" => 1,
        _ => 2,
    };
    let text = |name: &str| line[name].as_str().unwrap_or_default();
    let time = timestamp(line["time"].as_f64().unwrap_or_default());
    Proto::new()
        .message(1, time)
        .int(2, level)
        .text(3, text("text"))
        .text(4, text("origin"))
}
