//! Ropes, cloths and soft volumes: what a shape says of itself that the physics bends, where it is held, and the form that it has meanwhile.

pub mod body;
mod mesh;
pub mod rope;
mod text;

use std::fmt::Write;
use std::rc::Rc;

use geometry::Mesh;
use nalgebra::Point3;

use super::{Appearance, Shape};
use crate::{Data, Field, Handle, Object, Pose, References, Scene, SceneError, SceneResult};
use body::Body;
use rope::Rope;
use text::{comma, tuple, words};

/// Name of the custom data of a shape that say what rope it is: see [`Rope`].
pub const ROPE: &str = "softRope";
/// Name of the custom data of a shape that say what cloth or volume it is: see [`Body`].
pub const BODY: &str = "softBody";
/// Name of the custom data that say where it is held: see [`Pin`]. The objects are references under the same tag.
pub const PINS: &str = "softPins";

/// What a soft shape is.
#[derive(Debug, Clone, PartialEq)]
pub enum Soft {
    /// A rope or cable.
    Rope(Rope),
    /// A cloth or volume.
    Body(Body),
}

/// Where something soft is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pin {
    /// The point.
    pub point: usize,
    /// The object that holds it; None: the world.
    pub holder: Option<Handle>,
    /// In the frame of that object, metres.
    pub place: [f64; 3],
    /// Of a rope: whether the edge that begins there (ends there at the last point) keeps its direction and does not turn.
    pub clamped: bool,
}

/// The form of something soft that the physics moves.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftForm {
    /// In the world, metres.
    pub points: Vec<[f64; 3]>,
    /// By edge of a rope, N, or by triangle of a cloth, N/m; none of a volume.
    pub tensions: Vec<f64>,
    /// By edge or triangle: whether it is broken.
    pub broken: Vec<bool>,
    /// By pin, in their order: the force on what is soft, N.
    pub pin_forces: Vec<[f64; 3]>,
    /// Of the gas in a closed cloth, above that of the air outside, Pa.
    pub pressure: f64,
}

impl Soft {
    /// What custom data say; None if they describe nothing soft.
    fn of(object: &Object) -> Option<Self> {
        let parsed = |name, parse: fn(&str) -> Option<Self>| parse(&object.text(name)?);
        parsed(ROPE, |text| Rope::parse(text).map(Self::Rope))
            .or_else(|| parsed(BODY, |text| Body::parse(text).map(Self::Body)))
    }

    /// Where it begins, in the frame of the shape, metres.
    pub fn points(&self) -> &[[f64; 3]] {
        match self {
            Self::Rope(rope) => &rope.points,
            Self::Body(body) => &body.points,
        }
    }

    /// The pressure that it begins with.
    fn pressure(&self) -> f64 {
        match self {
            Self::Rope(_) => 0.0,
            Self::Body(body) => body.pressure.unwrap_or(0.0),
        }
    }

    /// Whether it touches itself.
    pub fn touches_itself(&self) -> bool {
        match self {
            Self::Rope(rope) => rope.touches_itself,
            Self::Body(body) => body.touches_itself,
        }
    }

    /// Whether its points can be in these places.
    pub fn can_be_at(&self, points: &[[f64; 3]]) -> bool {
        points.len() == self.points().len()
            && match self {
                Self::Rope(_) => rope::is_line(points),
                Self::Body(_) => body::are_places(points),
            }
    }

    /// Number of edges or triangles that can break.
    fn breakable(&self) -> usize {
        match self {
            Self::Rope(rope) => rope.points.len() - 1,
            Self::Body(body) if body.is_volume() => 0,
            Self::Body(body) => body.triangles.len(),
        }
    }

    /// Its mesh with points in these places, without what is broken.
    pub fn mesh(&self, points: &[[f64; 3]], broken: &[bool]) -> Mesh {
        match self {
            Self::Rope(rope) => rope::tube(points, rope.radius, broken),
            Self::Body(body) => mesh::of_body(body, points, broken),
        }
    }
}

impl Object {
    /// What this shape is, if it is soft.
    pub fn soft(&self) -> Option<Soft> {
        Soft::of(self)
    }

    /// The text that says so: equal texts mean the same.
    pub fn soft_text(&self) -> Option<String> {
        self.text(ROPE).or_else(|| self.text(BODY))
    }

    fn text(&self, name: &str) -> Option<String> {
        let (_, value) = self.custom_data.typed(name)?;
        match value {
            Data::Text(text) | Data::Buffer(text) => Some(String::from_utf8_lossy(text).into()),
            _ => None,
        }
    }

    /// Where this soft shape is held. A pin whose object is gone holds nothing.
    pub fn pins(&self) -> Vec<Pin> {
        let text = self.text(PINS).unwrap_or_default();
        let holders = self.referenced(References::Following, PINS);
        text.lines().filter_map(|line| pin(line, holders)).collect()
    }
}

/// A pin in its text: `point=3 holder=0 place=0,0,0 clamped=1`; the holder is one of the references.
fn pin(line: &str, holders: &[i64]) -> Option<Pin> {
    let mut pin = Pin {
        point: 0,
        holder: None,
        place: [0.0; 3],
        clamped: false,
    };
    for (name, value) in words(line) {
        match name {
            "point" => pin.point = value.parse().ok()?,
            "holder" => {
                let raw = holders.get(value.parse::<usize>().ok()?)?;
                pin.holder = Some(Handle::from_raw(*raw)?);
            }
            "place" => pin.place = tuple(value)?,
            "clamped" => pin.clamped = value != "0",
            _ => {}
        }
    }
    Some(pin)
}

impl Scene {
    /// Says where something soft is held.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn set_pins(&mut self, soft: Handle, pins: &[Pin]) -> SceneResult<()> {
        let (mut text, mut holders) = (String::new(), Vec::new());
        for pin in pins {
            let _ = write!(text, "point={} place={}", pin.point, comma(&pin.place));
            if let Some(holder) = pin.holder {
                let _ = write!(text, " holder={}", holders.len());
                holders.push(holder.raw());
            }
            if pin.clamped {
                text.push_str(" clamped=1");
            }
            text.push('\n');
        }
        self.set_references(soft, References::Following, PINS, &holders)?;
        self.set_text(soft, PINS, text)
    }

    /// Says what a shape is that the physics bends.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn set_soft(&mut self, shape: Handle, soft: &Soft) -> SceneResult<()> {
        match soft {
            Soft::Rope(rope) => self.set_text(shape, ROPE, rope.to_string()),
            Soft::Body(body) => self.set_text(shape, BODY, body.to_string()),
        }
    }

    fn set_text(&mut self, object: Handle, name: &str, text: String) -> SceneResult<()> {
        let value = (crate::ValueType::String, Data::Text(text.into_bytes()));
        self.edit_named_values(
            Some(object),
            crate::Namespace::CustomData,
            crate::Edit::Name(name, Some(value)),
        )?;
        self.modify(object, Field::Dynamics, |_| ())
    }

    /// The form of something soft: where the physics has it, or where it begins.
    ///
    /// # Errors
    /// When the shape is not soft.
    pub fn soft_form(&self, shape: Handle) -> SceneResult<SoftForm> {
        let object = self.object(shape)?;
        if let Some(form) = &object.shape()?.soft_form {
            return Ok(SoftForm::clone(form));
        }
        let soft = object.soft().ok_or_else(not_soft)?;
        let pose = self.world_pose(shape)?;
        let points = soft.points().iter();
        Ok(SoftForm {
            points: points
                .map(|point| (pose * Point3::from(*point)).into())
                .collect(),
            tensions: vec![0.0; soft.breakable()],
            broken: vec![false; soft.breakable()],
            pin_forces: Vec::new(),
            pressure: soft.pressure(),
        })
    }

    /// Takes over the form that something soft has; None: that which it begins with.
    ///
    /// # Errors
    /// When the shape is gone.
    pub fn report_soft_form(
        &mut self,
        shape: Handle,
        soft: &Soft,
        form: Option<SoftForm>,
    ) -> SceneResult<()> {
        let (points, broken) = match &form {
            Some(form) => {
                let into = self.world_pose(shape)?.inverse();
                let local = |point: &[f64; 3]| (into * Point3::from(*point)).into();
                (form.points.iter().map(local).collect(), form.broken.clone())
            }
            None => (soft.points().to_vec(), Vec::new()),
        };
        self.try_modify(shape, Field::Geometry, |object| {
            let shape = object.shape_mut()?;
            shape.soft_form = form.map(Rc::new);
            shape.show(soft, &points, &broken)
        })
    }
}

fn not_soft() -> SceneError {
    SceneError::Refused("the shape is not soft.".into())
}

impl Shape {
    /// Something soft as a shape, with points in the frame of the shape.
    ///
    /// # Errors
    /// When it has no form.
    pub fn of_soft(soft: &Soft, appearance: Appearance) -> SceneResult<Self> {
        let mut mesh = soft.mesh(soft.points(), &[]);
        mesh.compute_normals(appearance.shading_angle);
        let mut shape = Self::from_mesh(mesh, appearance)?;
        shape.show(soft, soft.points(), &[])?;
        shape.dynamics.respondable = true;
        shape.dynamics.is_static = false;
        Ok(shape)
    }

    /// Gives the mesh the form of something soft with points in the frame of the shape.
    fn show(&mut self, soft: &Soft, points: &[[f64; 3]], broken: &[bool]) -> SceneResult<()> {
        let part = self.parts.first_mut().ok_or(SceneError::InvalidData)?;
        let mut mesh = soft.mesh(points, broken);
        mesh.compute_normals(part.appearance.shading_angle.max(1.0));
        let fitted = mesh.bounding_box(&nalgebra::UnitQuaternion::identity());
        self.bounding_box = fitted.ok_or(SceneError::InvalidData)?;
        part.pose = Pose::identity();
        part.mesh = Rc::new(mesh);
        part.convex = false;
        Ok(())
    }
}

#[cfg(test)]
mod tests;
