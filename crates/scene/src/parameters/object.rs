//! Numbered parameters that all objects have (`sim.objintparam_*`, `sim.objfloatparam_*`), visibility and boxes.
//!
//! The parameters of each type are in `kind`. Numbers of removed functions (roles, permissions) are unknown.

use geometry::BoundingBox;
use nalgebra::{Point3, Vector3};

use crate::{
    Field, Handle, Kind, Layers, ModelFlags, Object, ObjectFlags, Pose, Scene, SceneResult,
    SpecialFlags,
};

/// `sim.dummystringparam_assemblytag`.
const ASSEMBLY_TAG: i64 = 10004;
/// `sim.shapestringparam_colorname`.
const COLOUR_NAME: i64 = 3032;

/// The box of a script, in sizes of its symbol.
const SCRIPT_BOX: f64 = 1.05;

/// Smallest and largest coordinates.
type Extent = (Vector3<f64>, Vector3<f64>);

impl Scene {
    /// The value of an integer parameter; None when the object has no such parameter.
    pub fn int_param(&self, handle: Handle, id: i64) -> SceneResult<Option<i64>> {
        let object = self.object(handle)?;
        match id {
            10 => Ok(Some(object.layer.number())),
            27 => Ok(Some(object.self_collision_indicator)),
            36 => Ok(Some(i64::from(self.is_visible(handle)?))),
            37 => Ok(Some(object.uid())),
            38 => Ok(Some(object.hierarchy_colour)),
            _ => self.kind_int_param(handle, id),
        }
    }

    /// Sets an integer parameter; false when the object has no such parameter, or only one to read.
    pub fn set_int_param(&mut self, handle: Handle, id: i64, value: i64) -> SceneResult<bool> {
        match id {
            10 => self.modify(handle, Field::Layer, |object| {
                object.layer = Layers::from_number(value);
            })?,
            27 => self.modify(handle, Field::Inert, |object| {
                object.self_collision_indicator = value;
            })?,
            38 => self.modify(handle, Field::Inert, |object| {
                object.hierarchy_colour = value;
            })?,
            _ => return self.set_kind_int_param(handle, id, value),
        }
        Ok(true)
    }

    /// The value of a float parameter (SI units); None when the object has no such parameter.
    pub fn float_param(&self, handle: Handle, id: i64) -> SceneResult<Option<f64>> {
        let object = self.object(handle)?;
        let measured = &object.measured;
        Ok(match id {
            11..=13 => Some(measured.linear()[(id - 11) as usize]),
            14 => Some(Vector3::from(measured.angular()).norm()),
            15..=20 => Some(corner(object.own_extent(), id - 15)),
            21..=26 => self
                .model_extent(handle)?
                .map(|extent| corner(extent, id - 21)),
            34 => Some(object.size_factor),
            _ => return self.kind_float_param(handle, id),
        })
    }

    /// The value of a text parameter; None when the object has no such parameter.
    pub fn string_param(&self, handle: Handle, id: i64) -> SceneResult<Option<Vec<u8>>> {
        let object = self.object(handle)?;
        Ok(match (&object.kind, id) {
            (_, 33) => Some(object.dna.clone()),
            (_, 35) => Some(object.persistent_uid.clone().into_bytes()),
            (Kind::Dummy(dummy), ASSEMBLY_TAG) => Some(dummy.assembly_tag.clone().into_bytes()),
            (Kind::Shape(shape), COLOUR_NAME) => shape
                .parts
                .first()
                .map(|part| part.appearance.colour_name.clone().into_bytes()),
            _ => None,
        })
    }

    /// Sets a text parameter; false when the object has no such parameter, or only one to read.
    pub fn set_string_param(&mut self, handle: Handle, id: i64, value: &[u8]) -> SceneResult<bool> {
        let text = String::from_utf8_lossy(value).into_owned();
        let field = match (&self.object(handle)?.kind, id) {
            (Kind::Dummy(_), ASSEMBLY_TAG) => Field::Inert,
            (Kind::Shape(_), COLOUR_NAME) => Field::Appearance,
            _ => return Ok(false),
        };
        self.modify(handle, field, |object| match &mut object.kind {
            Kind::Dummy(dummy) => dummy.assembly_tag = text,
            Kind::Shape(shape) => {
                shape
                    .parts
                    .iter_mut()
                    .for_each(|part| part.appearance.colour_name.clone_from(&text));
            }
            _ => {}
        })?;
        Ok(true)
    }

    /// Sets how sensors and calculations treat an object; any of the five detectable bits sets all of them.
    pub fn set_special_property(
        &mut self,
        handle: Handle,
        mut flags: SpecialFlags,
    ) -> SceneResult<()> {
        flags.set(
            SpecialFlags::DETECTABLE,
            flags.intersects(SpecialFlags::DETECTABLE),
        );
        self.modify(handle, Field::SpecialProperty, |object| {
            object.special_property = flags;
        })
    }

    /// Whether an object is shown: its layer is active and no model above hides it.
    pub fn is_visible(&self, handle: Handle) -> SceneResult<bool> {
        let layer = self.object(handle)?.layer;
        let hidden = self
            .calculated_model_property(handle)
            .contains(ModelFlags::NOT_VISIBLE);
        Ok(layer.intersects(self.settings().visibility_layers) && !hidden)
    }

    /// Box around a model in the frame of its base.
    fn model_extent(&self, base: Handle) -> SceneResult<Option<Extent>> {
        let into_base = self.world_pose(base)?.inverse();
        let mut total: Option<Extent> = None;
        for handle in self.subtree(base) {
            let object = self.object(handle)?;
            let left_out = handle != base
                && object
                    .object_property
                    .contains(ObjectFlags::HIDE_FROM_MODEL_BOX);
            if left_out {
                continue;
            }
            let (low, high) = transformed(object.extent(), &(into_base * self.world_pose(handle)?));
            total = Some(total.map_or((low, high), |(l, h)| (l.inf(&low), h.sup(&high))));
        }
        Ok(total)
    }
}

impl Object {
    /// Bounding box in the object's frame: of the meshes of a shape, of the voxels or points, otherwise of its graphical
    /// representation.
    pub fn bounding_box(&self) -> BoundingBox {
        let size = match &self.kind {
            Kind::Shape(shape) => return shape.bounding_box,
            Kind::Joint(joint) => {
                let [length, diameter] = joint.size;
                [diameter, diameter, length]
            }
            Kind::Dummy(dummy) => [dummy.size; 3],
            Kind::Graph(graph) => [graph.size; 3],
            Kind::Camera(camera) => [camera.size; 3],
            Kind::ProximitySensor(sensor) => [sensor.size; 3],
            Kind::VisionSensor(sensor) => [sensor.size; 3],
            Kind::ForceSensor(sensor) => [sensor.size; 3],
            Kind::Light(light) => [light.size; 3],
            Kind::Script(script) => [script.size * SCRIPT_BOX; 3],
            Kind::OcTree(octree) => return octree.bounding_box(),
            Kind::PointCloud(cloud) => return cloud.bounding_box(),
            Kind::Path(_) => [0.0; 3],
        };
        BoundingBox {
            size,
            pose: Pose::identity(),
        }
    }

    /// Smallest and largest coordinates of its box as parameters have it: those of shapes in the frame of the box.
    fn own_extent(&self) -> Extent {
        match &self.kind {
            Kind::Shape(shape) => {
                let half = Vector3::from(shape.bounding_box.size) * 0.5;
                (-half, half)
            }
            _ => self.extent(),
        }
    }

    /// Smallest and largest coordinates of the box along the axes of the object.
    pub fn extent(&self) -> Extent {
        let bounding_box = self.bounding_box();
        let half = Vector3::from(bounding_box.size) * 0.5;
        transformed((-half, half), &bounding_box.pose)
    }
}

/// Coordinate number `index` of min x, y, z, max x, y, z.
fn corner((low, high): Extent, index: i64) -> f64 {
    let (corner, axis) = if index < 3 {
        (low, index)
    } else {
        (high, index - 3)
    };
    corner[axis as usize]
}

/// The upright box around a box that is moved by `pose`.
fn transformed((low, high): Extent, pose: &Pose) -> Extent {
    let corners = (0..8).map(|i| {
        let pick = |axis: usize| {
            if i >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        };
        (pose * Point3::new(pick(0), pick(1), pick(2))).coords
    });
    let empty = (
        Vector3::repeat(f64::INFINITY),
        Vector3::repeat(f64::NEG_INFINITY),
    );
    corners.fold(empty, |(l, h), corner| (l.inf(&corner), h.sup(&corner)))
}
