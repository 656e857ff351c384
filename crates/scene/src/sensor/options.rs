//! Option bits of `sim.createProximitySensor` and `sim.createVisionSensor`.

use bitflags::bitflags;

bitflags! {
    /// Options of a new proximity sensor.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct ProximityOptions: i64 {
        const EXPLICIT_HANDLING = 0x1;
        const HIDE_VOLUME = 0x4;
        const IGNORE_FRONT_FACES = 0x8;
        const IGNORE_BACK_FACES = 0x10;
        /// Detects any point of an object, not the closest one.
        const FAST = 0x20;
        const ANGLE_THRESHOLD = 0x40;
        const CLOSE_THRESHOLD = 0x100;
        const RANDOMIZED = 0x200;
        const _ = !0;
    }
}

bitflags! {
    /// Options of a new vision sensor.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct VisionOptions: i64 {
        const EXPLICIT_HANDLING = 0x1;
        const PERSPECTIVE = 0x2;
        const HIDE_FRUSTUM = 0x4;
        const EXTERNAL_IMAGE = 0x10;
        /// Only lights that are attached to the sensor shine.
        const LOCAL_LIGHTS = 0x20;
        const IGNORE_FOG = 0x40;
        /// The background of its images is its own, not that of the scene.
        const OWN_BACKGROUND = 0x80;
        const _ = !0;
    }
}
