//! Animations: a sampler and a channel for each track and what it changes.

use serde_json::{Value, json};

use super::buffer::Buffer;
use crate::gltf::asset::{Animation, Track};

impl Buffer {
    /// None where nothing moves: an animation without channels is not allowed.
    pub(super) fn animation(&mut self, animation: &Animation) -> Option<Value> {
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for track in animation
            .tracks
            .iter()
            .filter(|track| !track.times.is_empty())
        {
            let times: Vec<[f64; 1]> = track.times.iter().map(|time| [*time]).collect();
            let input = self.vectors(&times, true, None);
            for (path, output) in self.paths(track) {
                channels.push(json!({ "sampler": samplers.len(), "target": { "node": track.node, "path": path } }));
                samplers.push(json!({ "input": input, "output": output }));
            }
        }
        if channels.is_empty() {
            return None;
        }
        let mut value = json!({ "samplers": samplers, "channels": channels });
        if !animation.name.is_empty() {
            value["name"] = json!(animation.name);
        }
        Some(value)
    }

    fn paths(&mut self, track: &Track) -> Vec<(&'static str, usize)> {
        let mut paths = Vec::new();
        if track.translations.len() == track.times.len() {
            paths.push((
                "translation",
                self.vectors(&track.translations, false, None),
            ));
        }
        if track.rotations.len() == track.times.len() {
            paths.push(("rotation", self.vectors(&track.rotations, false, None)));
        }
        paths
    }
}
