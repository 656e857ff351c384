//! How objects move while a simulation runs, and the animation that becomes of it.

use std::collections::{BTreeMap, BTreeSet};

use geometry::Pose;
use mesh_files::gltf::{Animation, Track};

use super::{GltfFile, Placed};
use scene::{Handle, Scene};

/// Most poses that are kept, some 600 MB.
const MAX_POSES: usize = 10_000_000;

/// The poses of all objects, each at those frames at which it was somewhere else than before.
#[derive(Debug, Default)]
pub struct Recording {
    is_on: bool,
    /// Of each frame: seconds since the first one.
    times: Vec<f64>,
    /// The last frame's simulation time.
    clock: f64,
    poses: BTreeMap<Handle, Vec<(usize, Pose)>>,
    kept: usize,
}

impl Recording {
    /// Begins a new recording.
    pub fn start(&mut self) {
        *self = Self {
            is_on: true,
            ..Self::default()
        };
    }

    /// Ends the recording; its frames stay.
    pub fn stop(&mut self) {
        self.is_on = false;
    }

    /// Whether frames are being recorded.
    pub fn is_on(&self) -> bool {
        self.is_on
    }

    /// Number of recorded frames.
    pub fn frames(&self) -> usize {
        self.times.len()
    }

    /// Adds a frame. False if there is no room for more: the recording ends.
    pub fn record(&mut self, scene: &Scene, simulation_time: f64, time_step: f64) -> bool {
        // A simulation that was started again begins at 0.
        let step = if simulation_time > self.clock {
            simulation_time - self.clock
        } else {
            time_step
        };
        self.times
            .push(self.times.last().map_or(0.0, |last| last + step));
        self.clock = simulation_time;
        let frame = self.times.len() - 1;
        for object in scene.objects() {
            let Ok(pose) = scene.world_pose(object.handle()) else {
                continue;
            };
            let poses = self.poses.entry(object.handle()).or_default();
            if poses.last().is_none_or(|(_, last)| *last != pose) {
                poses.push((frame, pose));
                self.kept += 1;
            }
        }
        self.is_on = self.kept < MAX_POSES;
        self.is_on
    }

    fn poses(&self, handle: Handle) -> &[(usize, Pose)] {
        self.poses.get(&handle).map_or(&[], Vec::as_slice)
    }

    /// Where the node of an object is at a frame; None if the object was never there.
    fn node_frame(&self, object: Placed, frame: usize) -> Option<Pose> {
        let poses = self.poses(object.handle);
        let next = poses.partition_point(|(first, _)| *first <= frame);
        let (_, pose) = poses.get(next.saturating_sub(1))?;
        Some(object.node_frame(*pose))
    }

    /// The frames at which one of two objects begins or ends to move.
    fn frames_of(&self, object: Placed, parent: Option<Placed>) -> BTreeSet<usize> {
        let both = [Some(object), parent].into_iter().flatten();
        both.flat_map(|object| self.poses(object.handle))
            .flat_map(|(frame, _)| [frame.saturating_sub(1), *frame])
            .collect()
    }
}

impl GltfFile {
    /// Adds what was recorded of the exported objects as an animation.
    pub fn add_animation(&mut self, recording: &Recording) {
        let mut tracks: BTreeMap<usize, Track> = BTreeMap::new();
        for exported in &self.exported {
            let poses = recording
                .frames_of(exported.object, exported.parent)
                .into_iter()
                .filter_map(|frame| {
                    let above = exported.parent.map_or(Some(Pose::identity()), |parent| {
                        recording.node_frame(parent, frame)
                    })?;
                    Some((
                        recording.times[frame],
                        above.inverse() * recording.node_frame(exported.object, frame)?,
                    ))
                });
            tracks.extend(track(exported.node, poses).map(|track| (exported.node, track)));
        }
        let tracks: Vec<Track> = tracks.into_values().collect();
        if !tracks.is_empty() {
            self.asset.animations.push(Animation {
                name: "animation".into(),
                tracks,
            });
        }
    }
}

/// None if the node stays where it is.
fn track(node: usize, poses: impl Iterator<Item = (f64, Pose)>) -> Option<Track> {
    let mut track = Track {
        node,
        ..Track::default()
    };
    for (time, pose) in poses {
        let rotation: [f64; 4] = pose.rotation.coords.into();
        // Of the two quaternions of a rotation, the one near the last: some viewers do not look for the shorter way.
        let turns_back = track
            .rotations
            .last()
            .is_some_and(|last| last.iter().zip(rotation).map(|(a, b)| a * b).sum::<f64>() < 0.0);
        track.times.push(time);
        track.translations.push(pose.translation.vector.into());
        track.rotations.push(if turns_back {
            rotation.map(|x| -x)
        } else {
            rotation
        });
    }
    if is_constant(&track.translations) {
        track.translations.clear();
    }
    if is_constant(&track.rotations) {
        track.rotations.clear();
    }
    (!(track.translations.is_empty() && track.rotations.is_empty())).then_some(track)
}

/// Whether all are the same in the 32 bits of a file, or nearly, as rounding leaves them.
fn is_constant<const N: usize>(rows: &[[f64; N]]) -> bool {
    rows.iter().all(|row| {
        row.iter()
            .zip(&rows[0])
            .all(|(a, b)| (a - b).abs() <= 1e-9 * (1.0 + b.abs()))
    })
}
