//! The objects of a recording at a time, as messages of Foxglove.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::proto::Proto;
use super::{WORLD, timestamp};
use crate::blobs::Hash;

/// Frames are named by paths of at most so many objects: a recording may be damaged.
const MAX_DEPTH: usize = 100;

/// What is known of objects.
#[derive(Default)]
pub(super) struct Objects {
    objects: BTreeMap<i64, Value>,
    meshes: BTreeMap<Hash, Mesh>,
}

/// The triangles of a mesh.
struct Mesh {
    points: Vec<[f64; 3]>,
    indices: Vec<u32>,
}

/// What a message changes.
#[derive(Default)]
pub(super) struct Changed {
    pub handles: BTreeSet<i64>,
    /// Frames of objects that are gone.
    gone: Vec<String>,
    /// Nothing that was there before is there.
    all_gone: bool,
}

impl Objects {
    pub(super) fn add_blob(&mut self, hash: Hash, bytes: &[u8]) {
        if let Some(mesh) = Mesh::of(bytes) {
            self.meshes.insert(hash, mesh);
        }
    }

    /// Takes over a message. The snapshot at the beginning of a chunk changes only what is another than before.
    pub(super) fn update(&mut self, message: &Value) -> Changed {
        let mut changed = Changed::default();
        let objects = message["objects"].as_array().into_iter().flatten();
        let objects: Vec<(i64, &Value)> = objects
            .filter_map(|object| Some((object["handle"].as_i64()?, object)))
            .collect();
        if message["type"] == "snapshot" {
            let there: BTreeSet<i64> = objects.iter().map(|(handle, _)| *handle).collect();
            let gone: Vec<i64> = self
                .objects
                .keys()
                .filter(|handle| !there.contains(handle))
                .copied()
                .collect();
            changed.all_gone = self.objects.is_empty();
            gone.into_iter()
                .for_each(|handle| self.remove(handle, &mut changed));
        }
        let removed = message["removed"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_i64);
        removed.for_each(|handle| self.remove(handle, &mut changed));
        for (handle, object) in objects {
            if self.objects.get(&handle) != Some(object) {
                self.objects.insert(handle, object.clone());
                changed.handles.insert(handle);
            }
        }
        changed
    }

    fn remove(&mut self, handle: i64, changed: &mut Changed) {
        if self.objects.contains_key(&handle) {
            changed.gone.push(self.frame(handle));
            self.objects.remove(&handle);
        }
    }

    /// The name of an object's frame: its path.
    pub(super) fn frame(&self, handle: i64) -> String {
        let mut names = Vec::new();
        let mut next = handle;
        while let Some(object) = self.objects.get(&next).filter(|_| names.len() < MAX_DEPTH) {
            let alias = object["alias"].as_str().unwrap_or("object");
            let order = object["childOrder"].as_i64().filter(|order| *order >= 0);
            names.push(
                order.map_or_else(|| format!("/{alias}"), |order| format!("/{alias}[{order}]")),
            );
            next = object["parent"].as_i64().unwrap_or(-1);
        }
        if names.is_empty() {
            format!("/{handle}")
        } else {
            names.into_iter().rev().collect()
        }
    }

    /// A `foxglove.FrameTransforms` of a message with poses; None if that is damaged.
    pub(super) fn transforms(&self, bytes: &[u8], time: f64) -> Option<Proto> {
        const POSE: usize = 4 + 7 * 4;
        let count = u32::from_le_bytes(*bytes.get(4..)?.first_chunk()?) as usize;
        let poses = bytes.get(16..)?.chunks_exact(POSE).take(count);
        if poses.len() != count {
            return None;
        }
        let transforms = poses.filter_map(|pose| {
            let handle = i64::from(i32::from_le_bytes(*pose.first_chunk()?));
            let numbers: Vec<f64> = pose[4..].chunks_exact(4).filter_map(number).collect();
            let transform = Proto::new()
                .message(1, timestamp(time))
                .text(2, WORLD)
                .text(3, &self.frame(handle));
            Some(
                transform
                    .message(4, Proto::doubles(&numbers[..3]))
                    .message(5, Proto::doubles(&numbers[3..])),
            )
        });
        Some(Proto::new().messages(1, transforms))
    }

    /// A vision sensor and its `foxglove.RawImage`; None if the message is damaged.
    pub(super) fn image(&self, bytes: &[u8], time: f64) -> Option<(i64, Proto)> {
        let word = |at: usize| Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?));
        let (handle, width, height) = (i64::from(word(4)? as i32), word(8)?, word(12)?);
        let pixels = bytes.get(24..)?;
        if pixels.len() as u64 != 3 * u64::from(width) * u64::from(height) {
            return None;
        }
        let image = Proto::new()
            .message(1, timestamp(time))
            .fixed32(2, width)
            .fixed32(3, height)
            .text(4, "rgb8");
        let image = image
            .fixed32(5, 3 * width)
            .bytes(6, pixels)
            .text(7, &self.frame(handle));
        Some((handle, image))
    }

    /// A `foxglove.JointStates` of those that changed; None if there are none.
    pub(super) fn joint_states(&self, handles: &BTreeSet<i64>, time: f64) -> Option<Proto> {
        let joints = handles.iter().filter_map(|handle| {
            let position = self.objects.get(handle)?["jointPosition"].as_f64()?;
            Some(
                Proto::new()
                    .text(1, &self.frame(*handle))
                    .double(2, position),
            )
        });
        let joints: Vec<Proto> = joints.collect();
        let states = Proto::new().message(1, timestamp(time));
        (!joints.is_empty()).then(|| states.messages(2, joints))
    }

    /// A `foxglove.SceneUpdate` of what changed; None if no shape did.
    pub(super) fn scene_update(&self, changed: &Changed, time: f64) -> Option<Proto> {
        const ALL: u64 = 1;
        let deletion = |kind, frame: &str| {
            Proto::new()
                .message(1, timestamp(time))
                .int(2, kind)
                .text(3, frame)
        };
        let mut deletions: Vec<Proto> = changed
            .gone
            .iter()
            .map(|frame| deletion(0, frame))
            .collect();
        if changed.all_gone {
            deletions.push(deletion(ALL, ""));
        }
        let mut entities = Vec::new();
        for handle in &changed.handles {
            let Some(object) = self
                .objects
                .get(handle)
                .filter(|object| object["meshes"].is_array())
            else {
                continue;
            };
            if object["visible"] == true {
                entities.push(self.entity(*handle, object, time));
            } else {
                deletions.push(deletion(0, &self.frame(*handle)));
            }
        }
        let is_empty = entities.is_empty() && deletions.is_empty();
        (!is_empty).then(|| Proto::new().messages(1, deletions).messages(2, entities))
    }

    /// A `foxglove.SceneEntity` of a shape, in its frame.
    fn entity(&self, handle: i64, object: &Value, time: f64) -> Proto {
        let frame = self.frame(handle);
        let entity = Proto::new()
            .message(1, timestamp(time))
            .text(2, &frame)
            .text(3, &frame);
        let triangles = object["meshes"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|mesh| self.triangles(mesh));
        // They move with their frame.
        entity
            .message(4, timestamp(0.0))
            .int(5, 1)
            .messages(12, triangles)
    }

    /// A `foxglove.TriangleListPrimitive`.
    fn triangles(&self, mesh: &Value) -> Option<Proto> {
        let blob = self.meshes.get(&Hash::from_text(mesh["blob"].as_str()?)?)?;
        let part = |at: usize| mesh["color"]["diffuse"][at].as_f64().unwrap_or(0.5);
        let opacity = 1.0 - mesh["transparency"].as_f64().unwrap_or(0.0);
        let pose = Proto::new()
            .message(1, Proto::doubles(&[0.0; 3]))
            .message(2, Proto::doubles(&[0.0, 0.0, 0.0, 1.0]));
        let primitive = Proto::new()
            .message(1, pose)
            .messages(2, blob.points.iter().map(|p| Proto::doubles(p)));
        let indices: Vec<u8> = blob
            .indices
            .iter()
            .flat_map(|index| index.to_le_bytes())
            .collect();
        Some(
            primitive
                .message(3, Proto::doubles(&[part(0), part(1), part(2), opacity]))
                .bytes(5, &indices),
        )
    }
}

impl Mesh {
    /// Of a blob; None where it is no mesh, or a damaged one.
    fn of(bytes: &[u8]) -> Option<Self> {
        let (head, rest) = bytes.strip_prefix(b"MESH")?.split_first_chunk::<16>()?;
        let [v0, v1, v2, v3, t0, t1, t2, t3, ..] = *head;
        let vertices = u32::from_le_bytes([v0, v1, v2, v3]);
        let triangles = u32::from_le_bytes([t0, t1, t2, t3]);
        let size = |count: u32| usize::try_from(count).ok()?.checked_mul(12);
        let (positions, rest) = rest.split_at_checked(size(vertices)?)?;
        let (indices, _) = rest.split_at_checked(size(triangles)?)?;
        let point = |bytes: &[u8]| {
            Some([
                number(&bytes[..4])?,
                number(&bytes[4..8])?,
                number(&bytes[8..])?,
            ])
        };
        let points = positions
            .chunks_exact(12)
            .map(point)
            .collect::<Option<_>>()?;
        let index = |bytes: &[u8]| Some(u32::from_le_bytes(*bytes.first_chunk()?));
        let indices: Vec<u32> = indices.chunks_exact(4).map(index).collect::<Option<_>>()?;
        indices
            .iter()
            .all(|index| *index < vertices)
            .then_some(Self { points, indices })
    }
}

/// The number in four bytes.
fn number(bytes: &[u8]) -> Option<f64> {
    Some(f64::from(f32::from_le_bytes(*bytes.first_chunk()?)))
}
