//! Option bits of `sim.createProximitySensor` and `sim.createVisionSensor`.

use bitflags::bitflags;

bitflags! {
    /// Options of a new proximity sensor.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct ProximityOptions: i64 {
        /// Handled only when a script asks for this sensor.
        const EXPLICIT_HANDLING = 0x1;
        /// The volume is not displayed.
        const HIDE_VOLUME = 0x4;
        /// The outer side of surfaces is not detected.
        const IGNORE_FRONT_FACES = 0x8;
        /// The inner side of surfaces is not detected.
        const IGNORE_BACK_FACES = 0x10;
        /// Detects any point of an object, not the closest one.
        const FAST = 0x20;
        /// Surfaces at a larger angle than the threshold are not detected.
        const ANGLE_THRESHOLD = 0x40;
        /// Objects nearer than the threshold suppress the detection.
        const CLOSE_THRESHOLD = 0x100;
        /// A ray takes several random directions per reading.
        const RANDOMIZED = 0x200;
        const _ = !0;
    }
}

bitflags! {
    /// Options of a new vision sensor.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct VisionOptions: i64 {
        /// Handled only when a script asks for this sensor.
        const EXPLICIT_HANDLING = 0x1;
        /// Perspective projection instead of an orthographic one.
        const PERSPECTIVE = 0x2;
        /// The view volume is not displayed.
        const HIDE_FRUSTUM = 0x4;
        /// The image comes from scripts.
        const EXTERNAL_IMAGE = 0x10;
        /// Only lights that are attached to the sensor shine.
        const LOCAL_LIGHTS = 0x20;
        /// Images have no fog.
        const IGNORE_FOG = 0x40;
        /// The background of its images is its own, not that of the scene.
        const OWN_BACKGROUND = 0x80;
        const _ = !0;
    }
}
