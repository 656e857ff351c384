//! Scaling of objects (spec: objects 7).

use std::rc::Rc;

use geometry::MAX_COORDINATE;
use geometry::Mesh;
use geometry::PrimitiveKind;
use nalgebra::{Matrix3, Point3, Vector3};

use crate::joint::{Control, Joint, JointType};
use crate::pose::placement::is_valid_pose;
use crate::sensor::View;
use crate::sensor::volume::Volume;
use crate::shape::reshape::too_large;
use crate::shape::{Part, Shape};
use crate::{Field, Handle, Kind, Object, Pose, Scene, SceneError, SceneResult};

/// Smaller factors are refused.
const MIN_FACTOR: f64 = 0.0001;

impl Scene {
    /// Scales objects, their masses too, and with `positions` also where they are in their parents' frames.
    ///
    /// # Errors
    /// When an object does not exist, the factor is too small, or an object would become too large; nothing is scaled then.
    pub fn scale_objects(
        &mut self,
        handles: &[Handle],
        factor: f64,
        positions: bool,
    ) -> SceneResult<()> {
        check_factors(&[factor])?;
        for &handle in handles {
            self.object(handle)?.check_scaling(factor)?;
        }
        for &handle in handles {
            self.modify(handle, Field::Geometry, |object| {
                object.scale(factor);
                if positions {
                    let scaled = Pose {
                        translation: (object.pose.translation.vector * factor).into(),
                        ..object.pose
                    };
                    if is_valid_pose(&scaled) {
                        object.pose = scaled;
                    }
                }
            })?;
        }
        Ok(())
    }

    /// Scales one object along the axes of its box; mass and inertia stay. Shapes that must keep their form, and all other objects,
    /// use the first factor where several have to be the same.
    ///
    /// # Errors
    /// When the object does not exist, a factor is too small, or the object would become too large.
    pub fn scale_object(&mut self, handle: Handle, factors: [f64; 3]) -> SceneResult<()> {
        check_factors(&factors)?;
        self.object(handle)?
            .check_scaling(factors.into_iter().fold(0.0, f64::max))?;
        self.modify(handle, Field::Geometry, |object| match &mut object.kind {
            Kind::Shape(shape) => {
                let factors = shape.possible_factors(factors);
                shape.scale_geometry(factors);
                for (value, factor) in object.size_values.iter_mut().zip(factors) {
                    *value *= factor;
                }
            }
            _ => object.scale(factors[0]),
        })
    }
}

fn check_factors(factors: &[f64]) -> SceneResult<()> {
    let possible = |f: &f64| f.is_finite() && *f >= MIN_FACTOR;
    if factors.iter().all(possible) {
        Ok(())
    } else {
        Err(SceneError::InvalidInput)
    }
}

impl Object {
    /// Whether the object can be scaled, and a file still hold it.
    fn check_scaling(&self, factor: f64) -> SceneResult<()> {
        if self.size_factor * factor > MAX_COORDINATE {
            return Err(too_large());
        }
        self.shape()
            .map_or(Ok(()), |shape| shape.check_extent(factor))
    }

    /// Scales all lengths, and what follows from them.
    fn scale(&mut self, factor: f64) {
        self.size_factor *= factor;
        self.size_values = self.size_values.map(|value| value * factor);
        self.dynamics_reset = true;
        match &mut self.kind {
            Kind::Shape(shape) => shape.scale(factor),
            Kind::Joint(joint) => joint.scale(factor),
            Kind::Dummy(dummy) => dummy.size *= factor,
            Kind::ForceSensor(sensor) => {
                sensor.size *= factor;
                sensor.force_threshold *= factor.powi(3);
                sensor.torque_threshold *= factor.powi(4);
                sensor.samples.clear();
            }
            Kind::ProximitySensor(sensor) => {
                sensor.size *= factor;
                sensor.volume.scale(factor);
            }
            Kind::VisionSensor(sensor) => {
                sensor.size *= factor;
                sensor.view.scale(factor);
            }
            Kind::Camera(camera) => {
                camera.size *= factor;
                camera.view.scale(factor);
            }
            Kind::Light(light) => light.size *= factor,
            Kind::Path(path) => path.scale(factor),
            Kind::Graph(graph) => graph.size *= factor,
            Kind::OcTree(octree) => octree.scale(factor),
            Kind::PointCloud(cloud) => cloud.scale(factor),
            Kind::Script(script) => script.size *= factor,
        }
    }
}

impl Volume {
    fn scale(&mut self, factor: f64) {
        let pairs = self
            .x_size
            .iter_mut()
            .chain(&mut self.y_size)
            .chain(&mut self.radius);
        pairs.for_each(|length| *length *= factor);
        (self.offset, self.range) = (self.offset * factor, self.range * factor);
        self.close_threshold *= factor;
    }
}

impl View {
    fn scale(&mut self, factor: f64) {
        self.ortho_size *= factor;
        self.clipping = self.clipping.map(|distance| distance * factor);
    }
}

impl Joint {
    fn scale(&mut self, s: f64) {
        self.size = self.size.map(|length| length * s);
        match self.joint_type {
            JointType::Revolute => {
                self.screw_lead *= s;
                self.target_force *= s.powi(4);
                self.spring = self.spring.map(|k| k * s.powi(4));
            }
            JointType::Prismatic => self.scale_prismatic(s),
            JointType::Spherical => {}
        }
    }

    fn scale_prismatic(&mut self, s: f64) {
        let lengths = [
            &mut self.position,
            &mut self.min,
            &mut self.range,
            &mut self.target_position,
            &mut self.target_velocity,
            &mut self.max_vel,
            &mut self.max_accel,
            &mut self.max_jerk,
        ];
        lengths.into_iter().for_each(|length| *length *= s);
        if let Some(law) = &mut self.dependency {
            law.offset *= s;
        }
        self.spring = self.spring.map(|k| k * s.powi(2));
        match self.control {
            Control::Spring | Control::SpringOrCallback => self.target_force *= s.powi(2),
            Control::Position | Control::PositionOrCallback => self.target_force *= s.powi(3),
            _ => {}
        }
    }
}

impl Shape {
    /// Scales geometry and mass.
    fn scale(&mut self, factor: f64) {
        self.scale_geometry([factor; 3]);
        self.mass = self.mass.scaled(factor);
        for part in &mut self.parts {
            part.mass = part.mass.scaled(factor);
        }
    }

    /// The factors a shape allows: round primitives stay round, compounds keep their proportions.
    fn possible_factors(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [part] = &self.parts[..] else {
            return [x; 3];
        };
        match part.primitive.as_ref().map(|primitive| primitive.kind) {
            Some(PrimitiveKind::Plane) => [x, y, 1.0],
            Some(PrimitiveKind::Disc) => [x, x, 1.0],
            Some(PrimitiveKind::Cylinder | PrimitiveKind::Cone | PrimitiveKind::Heightfield) => {
                [x, x, z]
            }
            Some(PrimitiveKind::Spheroid | PrimitiveKind::Capsule) => [x; 3],
            Some(PrimitiveKind::Cuboid) | None => [x, y, z],
        }
    }

    /// Scales along the axes of the bounding box, about the origin of the shape.
    fn scale_geometry(&mut self, factors: [f64; 3]) {
        let axes = self.bounding_box.pose.rotation.to_rotation_matrix();
        let scale = axes.matrix()
            * Matrix3::from_diagonal(&Vector3::from(factors))
            * axes.matrix().transpose();
        for part in &mut self.parts {
            part.scale(&scale, factors);
        }
        let size = &mut self.bounding_box.size;
        *size = [0, 1, 2].map(|i| size[i] * factors[i]);
        let centre = &mut self.bounding_box.pose.translation.vector;
        *centre = scale * *centre;
    }
}

impl Part {
    /// Applies the linear map `scale` of the shape frame; `factors` are those along the part's own axes if it is a primitive.
    fn scale(&mut self, scale: &Matrix3<f64>, factors: [f64; 3]) {
        let before = self.pose;
        self.pose.translation.vector = scale * before.translation.vector;
        let back = self.pose.inverse();
        let map = |vertex: &[f64; 3]| {
            <[f64; 3]>::from(
                (back * Point3::from(scale * (before * Point3::from(*vertex)).coords)).coords,
            )
        };
        let mesh = Mesh {
            vertices: self.mesh.vertices.iter().map(map).collect(),
            ..Mesh::clone(&self.mesh)
        };
        self.mesh = Rc::new(with_normals(mesh, factors));
        if let Some(primitive) = &mut self.primitive {
            primitive.size = [0, 1, 2].map(|i| primitive.size[i] * factors[i]);
            if let Some(field) = &mut primitive.heights {
                Rc::make_mut(field)
                    .heights
                    .iter_mut()
                    .for_each(|height| *height *= factors[2]);
            }
        }
    }
}

/// Uneven factors turn the normals: they become flat.
fn with_normals(mut mesh: Mesh, [x, y, z]: [f64; 3]) -> Mesh {
    if x != y || x != z {
        mesh.compute_normals(0.0);
    }
    mesh
}
