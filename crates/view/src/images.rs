//! Images of vision sensors as messages (docs/VIEW_PROTOCOL.md, kind 2): only those that are other ones than before.

use std::collections::{BTreeMap, BTreeSet};

use scene::{Handle, Scene};

/// What of the images of sensors was shown last: time and length do not tell, so the bytes are compared.
#[derive(Default)]
pub(super) struct Images {
    shown: BTreeMap<i64, Vec<u8>>,
}

impl Images {
    /// Forgets sensors that nobody wants to see.
    pub(super) fn keep(&mut self, wanted: &BTreeSet<i64>) {
        self.shown.retain(|sensor, _| wanted.contains(sensor));
    }

    /// All images are new again.
    pub(super) fn forget(&mut self) {
        self.shown.clear();
    }

    /// The image of a sensor, if it is another one than was shown.
    pub(super) fn new_image(&mut self, scene: &Scene, sensor: i64, time: f64) -> Option<Vec<u8>> {
        let object = scene
            .object(Handle::from_raw(sensor)?)
            .ok()?
            .vision_sensor()
            .ok()?;
        let pixels = object.image();
        if self
            .shown
            .get(&sensor)
            .is_some_and(|shown| **shown == *pixels)
        {
            return None;
        }
        self.shown.insert(sensor, pixels.to_vec());
        let [width, height] = object.view.resolution;
        let mut message = vec![2, 0, 0, 0];
        message.extend_from_slice(&(sensor as i32).to_le_bytes());
        message.extend_from_slice(&width.to_le_bytes());
        message.extend_from_slice(&height.to_le_bytes());
        message.extend_from_slice(&time.to_le_bytes());
        let row = 3 * width as usize;
        pixels
            .chunks_exact(row)
            .rev()
            .for_each(|row| message.extend_from_slice(row));
        Some(message)
    }

    /// The new images of all sensors of a scene, in the order of their handles.
    pub(super) fn of_all(&mut self, scene: &Scene, time: f64) -> Vec<Vec<u8>> {
        let sensors: Vec<i64> = scene
            .objects()
            .filter(|object| object.vision_sensor().is_ok())
            .map(|object| object.handle().raw())
            .collect();
        sensors
            .into_iter()
            .filter_map(|sensor| self.new_image(scene, sensor, time))
            .collect()
    }
}
