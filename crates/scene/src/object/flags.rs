//! Bit sets of objects, with the numbers that scripts and files use. Bits without a name are stored and read back.

use bitflags::bitflags;

bitflags! {
    /// `sim.objectproperty_*`: display and selection.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct ObjectFlags: i64 {
        /// Left out when a view is fitted to the scene.
        const IGNORE_VIEW_FITTING = 0x1;
        /// Shown collapsed in the tree.
        const COLLAPSED = 0x10;
        /// Can be selected with the mouse.
        const SELECTABLE = 0x20;
        /// A click on it selects the model it belongs to.
        const SELECT_MODEL = 0x80;
        /// Left out of the bounding boxes of models.
        const HIDE_FROM_MODEL_BOX = 0x100;
        /// A click passes through it.
        const SELECT_INVISIBLE = 0x800;
        /// Left out of depth images.
        const DEPTH_INVISIBLE = 0x1000;
        /// Protected from deletion while no simulation runs.
        const CANNOT_DELETE = 0x2000;
        /// Protected from deletion during a simulation.
        const CANNOT_DELETE_IN_SIMULATION = 0x4000;
        /// On no layer during a simulation.
        const HIDDEN_FOR_SIMULATION = 0x1_0000;
        const _ = !0;
    }
}

bitflags! {
    /// `sim.objectspecialproperty_*`: how sensors and calculations treat an object.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct SpecialFlags: i64 {
        /// Takes part in collision detection.
        const COLLIDABLE = 0x1;
        /// Takes part in distance measurement.
        const MEASURABLE = 0x2;
        /// Five bits for kinds of sensors, used as one.
        const DETECTABLE = 0x1f0;
        /// Seen by vision sensors.
        const RENDERABLE = 0x200;
        const _ = !0;
    }
}

bitflags! {
    /// `sim.modelproperty_*`: what a model base switches off for all that is below it.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct ModelFlags: i64 {
        /// Nothing of the model is collidable.
        const NOT_COLLIDABLE = 0x1;
        /// Nothing of the model is measurable.
        const NOT_MEASURABLE = 0x2;
        /// Vision sensors see nothing of the model.
        const NOT_RENDERABLE = 0x4;
        /// Proximity sensors detect nothing of the model.
        const NOT_DETECTABLE = 0x8;
        /// The physics moves nothing of the model.
        const NOT_DYNAMIC = 0x20;
        /// Nothing of the model responds to contacts.
        const NOT_RESPONDABLE = 0x40;
        /// Keeps the state of the run when a simulation ends.
        const NOT_RESET = 0x80;
        /// Nothing of the model is shown.
        const NOT_VISIBLE = 0x100;
        /// No script of the model runs.
        const SCRIPTS_INACTIVE = 0x200;
        /// Left out of the bounding box of the model it is part of.
        const NOT_IN_PARENT_BOX = 0x400;
        /// No model base.
        const NOT_MODEL = 0xf000;
        const _ = !0;
    }
}

bitflags! {
    /// Movements that a user interface must not offer.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct ForbiddenMovements: i64 {
        /// Translation while no simulation runs.
        const TRANSLATION_STOPPED = 0x1;
        /// Translation during a simulation.
        const TRANSLATION_RUNNING = 0x2;
        /// Rotation while no simulation runs.
        const ROTATION_STOPPED = 0x4;
        /// Rotation during a simulation.
        const ROTATION_RUNNING = 0x8;
        /// Translation along axes other than the preferred ones.
        const OTHER_TRANSLATIONS = 0x10;
        /// Rotation about axes other than the preferred ones.
        const OTHER_ROTATIONS = 0x20;
        const _ = !0;
    }
}

bitflags! {
    /// Axes along or about which a user interface moves an object.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct PreferredAxes: i64 {
        /// Translation along x.
        const TRANSLATION_X = 0x1;
        /// Translation along y.
        const TRANSLATION_Y = 0x2;
        /// Translation along z.
        const TRANSLATION_Z = 0x4;
        /// Rotation about x.
        const ROTATION_X = 0x8;
        /// Rotation about y.
        const ROTATION_Y = 0x10;
        /// Rotation about z.
        const ROTATION_Z = 0x20;
        const _ = !0;
    }
}

impl PreferredAxes {
    /// All six axes.
    pub const ALL_AXES: Self = Self::from_bits_retain(0x3f);
}

bitflags! {
    /// Which parts of an object the physics simulates.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct DynamicFlags: i64 {
        /// A shape responds to contacts.
        const RESPONDABLE = 1;
        /// A shape moves under forces.
        const DYNAMIC = 2;
        /// A joint connects two bodies of the physics.
        const JOINT = 4;
        /// A force sensor connects two bodies of the physics.
        const FORCE_SENSOR = 32;
        /// A dummy closes a loop of the physics.
        const DUMMY = 64;
    }
}

bitflags! {
    /// The visibility layers an object is on, or those that are shown.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Layers: u16 {
        /// Default layer of shapes.
        const SHAPES = 0x1;
        /// Default layer of joints.
        const JOINTS = 0x2;
        /// Default layer of dummies.
        const DUMMIES = 0x4;
        /// Default layer of proximity, vision and force sensors.
        const SENSORS = 0x8;
        /// Default layer of cameras and lights.
        const CAMERAS_AND_LIGHTS = 0x10;
        /// Default layer of graphs.
        const GRAPHS = 0x20;
        /// Default layer of paths.
        const PATHS = 0x20;
        /// Default layer of octrees and point clouds.
        const VOXELS = 0x40;
        /// Default layer of scripts.
        const SCRIPTS = 0x400;
        /// Those shown by default.
        const SHOWN_BY_DEFAULT = 0xff;
        const _ = !0;
    }
}

impl Layers {
    /// From a number of a script, of which the low 16 bits count.
    pub fn from_number(number: i64) -> Self {
        Self::from_bits_retain(number as u16)
    }

    /// The number scripts see, 0 to 65535.
    pub fn number(self) -> i64 {
        self.bits().into()
    }

    /// The layers above those shown by default that correspond to them.
    pub fn hidden(self) -> Self {
        Self::from_bits_retain(self.bits() << 8)
    }
}

#[cfg(test)]
mod tests {
    use super::{Layers, ModelFlags, ObjectFlags};

    #[test]
    fn a_layer_is_a_number_of_16_bits() {
        assert_eq!(Layers::from_number(0x7001_8300).number(), 0x8300);
        assert_eq!(Layers::from_number(-1).number(), 0xffff);
        assert_eq!(Layers::DUMMIES.hidden().number(), 0x400);
    }

    #[test]
    fn bits_without_a_name_are_kept() {
        let mut flags = ObjectFlags::from_bits_retain(0x7000_0000_0000_0020);
        flags.set(ObjectFlags::SELECTABLE, false);
        assert_eq!(flags.bits(), 0x7000_0000_0000_0000);
        let all = ModelFlags::from_bits_retain(-1);
        assert_eq!((all - ModelFlags::NOT_RESET).bits(), !0x80);
    }
}
