//! The default scene: a floor, a camera, lights.

use geometry::PrimitiveKind;
use nalgebra::UnitQuaternion;

use crate::object::dummy::Dummy;
use crate::sensor::{Light, LightType};
use crate::shape::options::PrimitiveOptions;
use crate::shape::{Material, Shape};
use crate::{Field, Handle, Kind, Layers, ModelFlags, Pose, Scene, SceneResult};

/// Full extents of the floor, m. Its top is the plane z = 0.
const FLOOR: [f64; 3] = [5.0, 5.0, 0.2];
/// The layer of the floor's body. It is not shown, as a separate visible shape would lie on top of it.
const FLOOR_LAYER: Layers = Layers::from_bits_retain(0x8000);
/// The last of the preset materials.
const FLOOR_MATERIAL: i64 = Material::FIRST_PRESET + 8;
/// Where the camera and the lights are, m.
const CAMERA_AT: [f64; 3] = [-2.0, -1.5, 1.6];
const LIGHTS_AT: [[f64; 3]; 2] = [[2.0, 2.0, 4.0], [-2.0, -2.0, 4.0]];

impl Scene {
    /// Adds the floor, a camera and lights, as a new scene has them.
    ///
    /// # Errors
    /// When the scene is full.
    pub fn add_default_objects(&mut self) -> SceneResult<()> {
        self.add_floor()?;
        let camera = self.add("DefaultCamera", Kind::Camera(Box::default()))?;
        self.set_world_pose(camera, looking_at_origin(CAMERA_AT))?;
        let lights = self.add("DefaultLights", Kind::Dummy(Dummy::new(0.1)))?;
        for at in LIGHTS_AT {
            let light = self.add(
                "light",
                Kind::Light(Box::new(Light::new(LightType::Directional))),
            )?;
            self.set_world_pose(light, looking_at_origin(at))?;
            self.set_parent(light, Some(lights), true)?;
        }
        Ok(())
    }

    fn add_floor(&mut self) -> SceneResult<Handle> {
        let mut shape =
            Shape::primitive(PrimitiveKind::Cuboid, FLOOR, PrimitiveOptions::default())?;
        shape.dynamics.respondable = true;
        shape.material = Material::preset(FLOOR_MATERIAL).unwrap_or_default();
        let floor = self.add("Floor", Kind::Shape(Box::new(shape)))?;
        self.set_world_pose(floor, Pose::translation(0.0, 0.0, -0.5 * FLOOR[2]))?;
        self.modify(floor, Field::ModelProperty, |object| {
            object.model_property = ModelFlags::empty();
            object.layer = FLOOR_LAYER;
        })?;
        Ok(floor)
    }
}

/// A frame at `position` whose z axis points at the origin and whose y axis points up.
fn looking_at_origin(position: [f64; 3]) -> Pose {
    let position = nalgebra::Vector3::from(position);
    let rotation = UnitQuaternion::face_towards(&-position, &nalgebra::Vector3::z());
    Pose::from_parts(position.into(), rotation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_carries_at_zero() {
        let mut scene = Scene::new();
        scene.add_default_objects().unwrap();
        let floor = scene.object(scene.roots()[0]).unwrap();
        assert!(floor.is_model() && floor.alias() == "Floor");
        let shape = floor.shape().unwrap();
        assert!(shape.dynamics.is_static && shape.dynamics.respondable && shape.is_pure());
        assert_eq!(
            floor.pose().translation.z + 0.5 * shape.bounding_box.size[2],
            0.0
        );
    }
}
