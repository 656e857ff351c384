//! Ropes and cables: what a shape says of itself that the physics bends, and the form that it has meanwhile.

use std::fmt::Write;
use std::rc::Rc;

use geometry::Mesh;
use nalgebra::{Point3, Vector3};

use super::{Appearance, Shape};
use crate::{Data, Field, Handle, Object, Pose, References, Scene, SceneError, SceneResult};

/// Name of the custom data of a shape that say what rope it is: see [`Rope`].
pub const ROPE: &str = "softRope";
/// Name of the custom data that say where it is held: see [`Pin`]. The objects are references under the same tag.
pub const PINS: &str = "softPins";

/// Largest number of points of a rope.
pub const MAX_POINTS: usize = 2000;
/// Corners of a cross section.
const SIDES: usize = 8;

/// A rope or cable. As text, `radius=0.005 ... points=0,0,1;0,0,0.5`.
#[derive(Debug, Clone, PartialEq)]
pub struct Rope {
    /// Radius, metres.
    pub radius: f64,
    /// Mass of a metre, kg.
    pub line_density: f64,
    /// Force per strain, N.
    pub stretch: f64,
    /// Moment per curvature, N m2.
    pub bend: f64,
    /// Torque per twist of a metre, N m2.
    pub twist: f64,
    /// Ratio of viscous to elastic stiffness, seconds.
    pub damping: f64,
    /// What the air takes of the velocity, per second.
    pub drag: f64,
    /// Tension at which it breaks, N; infinite: it does not.
    pub strength: f64,
    /// Length at rest, metres; 0: that of the points.
    pub length: f64,
    /// Whether it is straight at rest, otherwise as the points say.
    pub straight: bool,
    /// Whether it touches itself.
    pub touches_itself: bool,
    /// In the frame of the shape, metres.
    pub points: Vec<[f64; 3]>,
}

/// Where a rope is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pin {
    /// The point of the rope.
    pub point: usize,
    /// The object that holds it; None: the world.
    pub holder: Option<Handle>,
    /// In the frame of that object, metres.
    pub place: [f64; 3],
    /// Whether the edge that begins there (ends there at the last point) keeps its direction and does not turn.
    pub clamped: bool,
}

/// The form of a rope that the physics moves.
#[derive(Debug, Clone, PartialEq)]
pub struct RopeForm {
    /// In the world, metres.
    pub points: Vec<[f64; 3]>,
    /// By edge, N.
    pub tensions: Vec<f64>,
    /// By edge: whether it is broken.
    pub broken: Vec<bool>,
    /// By pin, in their order: the force on the rope, N.
    pub pin_forces: Vec<[f64; 3]>,
}

impl Rope {
    /// What a text says; None if it describes no rope.
    pub fn parse(text: &str) -> Option<Self> {
        let mut rope = Self {
            radius: 0.0,
            line_density: 0.0,
            stretch: 0.0,
            bend: 0.0,
            twist: 0.0,
            damping: 0.0,
            drag: 0.0,
            strength: f64::INFINITY,
            length: 0.0,
            straight: true,
            touches_itself: false,
            points: Vec::new(),
        };
        for (name, value) in words(text) {
            match name {
                "straight" => rope.straight = value != "0",
                "self" => rope.touches_itself = value != "0",
                "points" => rope.points = value.split(';').map(triple).collect::<Option<_>>()?,
                _ => {
                    if let Some(field) = rope.number(name) {
                        *field = value.parse().ok()?;
                    }
                }
            }
        }
        rope.is_valid().then_some(rope)
    }

    fn number(&mut self, name: &str) -> Option<&mut f64> {
        Some(match name {
            "radius" => &mut self.radius,
            "lineDensity" => &mut self.line_density,
            "stretch" => &mut self.stretch,
            "bend" => &mut self.bend,
            "twist" => &mut self.twist,
            "damping" => &mut self.damping,
            "drag" => &mut self.drag,
            "strength" => &mut self.strength,
            "length" => &mut self.length,
            _ => return None,
        })
    }

    /// Whether numbers are in the ranges that they can be computed with, and neighbours apart.
    pub fn is_valid(&self) -> bool {
        let positive = [
            self.radius,
            self.line_density,
            self.stretch,
            self.bend,
            self.twist,
        ];
        let others = [self.damping, self.drag, self.length];
        let apart = |pair: &[[f64; 3]]| Vector3::from(pair[0]) != Vector3::from(pair[1]);
        positive.iter().all(|x| x.is_finite() && *x > 0.0)
            && others.iter().all(|x| x.is_finite() && *x >= 0.0)
            && self.strength > 0.0
            && (2..=MAX_POINTS).contains(&self.points.len())
            && self
                .points
                .iter()
                .flatten()
                .all(|x| x.is_finite() && x.abs() < 1e4)
            && self.points.windows(2).all(apart)
    }
}

impl std::fmt::Display for Rope {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "radius={} lineDensity={} ",
            self.radius, self.line_density
        )?;
        write!(
            f,
            "stretch={} bend={} twist={} ",
            self.stretch, self.bend, self.twist
        )?;
        write!(f, "damping={} drag={} ", self.damping, self.drag)?;
        write!(f, "strength={} length={} ", self.strength, self.length)?;
        write!(
            f,
            "straight={} self={} ",
            u8::from(self.straight),
            u8::from(self.touches_itself)
        )?;
        let points: Vec<String> = self.points.iter().map(comma).collect();
        write!(f, "points={}", points.join(";"))
    }
}

fn words(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split_whitespace()
        .filter_map(|word| word.split_once('='))
}

fn comma(point: &[f64; 3]) -> String {
    format!("{},{},{}", point[0], point[1], point[2])
}

fn triple(text: &str) -> Option<[f64; 3]> {
    let mut numbers = text.split(',').map(|part| part.parse::<f64>().ok());
    let triple = [numbers.next()??, numbers.next()??, numbers.next()??];
    numbers.next().is_none().then_some(triple)
}

impl Object {
    /// What rope this shape is, if it is one.
    pub fn rope(&self) -> Option<Rope> {
        Rope::parse(&self.text(ROPE)?)
    }

    fn text(&self, name: &str) -> Option<String> {
        let (_, value) = self.custom_data.typed(name)?;
        match value {
            Data::Text(text) | Data::Buffer(text) => Some(String::from_utf8_lossy(text).into()),
            _ => None,
        }
    }

    /// Where this rope is held. A pin whose object is gone holds nothing.
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
            "place" => pin.place = triple(value)?,
            "clamped" => pin.clamped = value != "0",
            _ => {}
        }
    }
    Some(pin)
}

impl Scene {
    /// Says where a rope is held.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn set_pins(&mut self, rope: Handle, pins: &[Pin]) -> SceneResult<()> {
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
        self.set_references(rope, References::Following, PINS, &holders)?;
        self.set_text(rope, PINS, text)
    }

    /// Makes a shape a rope.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn set_rope(&mut self, shape: Handle, rope: &Rope) -> SceneResult<()> {
        self.set_text(shape, ROPE, rope.to_string())
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

    /// The form of a rope: where the physics has it, or where it begins.
    ///
    /// # Errors
    /// When the shape is no rope.
    pub fn rope_form(&self, shape: Handle) -> SceneResult<RopeForm> {
        let object = self.object(shape)?;
        if let Some(form) = &object.shape()?.rope_form {
            return Ok(RopeForm::clone(form));
        }
        let rope = object.rope().ok_or_else(no_rope)?;
        let pose = self.world_pose(shape)?;
        let edges = rope.points.len() - 1;
        Ok(RopeForm {
            points: rope
                .points
                .iter()
                .map(|point| (pose * Point3::from(*point)).into())
                .collect(),
            tensions: vec![0.0; edges],
            broken: vec![false; edges],
            pin_forces: Vec::new(),
        })
    }

    /// Takes over the form that the physics gives a rope; None: that which it begins with.
    ///
    /// # Errors
    /// When the shape is no rope.
    pub fn report_rope(&mut self, shape: Handle, form: Option<RopeForm>) -> SceneResult<()> {
        let rope = self.object(shape)?.rope().ok_or_else(no_rope)?;
        let (points, broken) = match &form {
            Some(form) => {
                let into = self.world_pose(shape)?.inverse();
                let local = |point: &[f64; 3]| (into * Point3::from(*point)).into();
                (form.points.iter().map(local).collect(), form.broken.clone())
            }
            None => (rope.points.clone(), Vec::new()),
        };
        self.try_modify(shape, Field::Geometry, |object| {
            let shape = object.shape_mut()?;
            shape.rope_form = form.map(Rc::new);
            shape.show_rope(rope.radius, &points, &broken)
        })
    }
}

fn no_rope() -> SceneError {
    SceneError::Refused("the shape is no rope.".into())
}

impl Shape {
    /// A rope as a shape, with points in the frame of the shape.
    ///
    /// # Errors
    /// When it has no form.
    pub fn of_rope(rope: &Rope, appearance: Appearance) -> SceneResult<Self> {
        let mut mesh = tube(&rope.points, rope.radius, &[]);
        mesh.compute_normals(appearance.shading_angle);
        let mut shape = Self::from_mesh(mesh, appearance)?;
        shape.show_rope(rope.radius, &rope.points, &[])?;
        shape.dynamics.respondable = true;
        shape.dynamics.is_static = false;
        Ok(shape)
    }

    /// Gives the mesh the form of a rope through points in the frame of the shape.
    fn show_rope(&mut self, radius: f64, points: &[[f64; 3]], broken: &[bool]) -> SceneResult<()> {
        let part = self.parts.first_mut().ok_or(SceneError::InvalidData)?;
        let mut mesh = tube(points, radius, broken);
        mesh.compute_normals(part.appearance.shading_angle.max(1.0));
        let fitted = mesh.bounding_box(&nalgebra::UnitQuaternion::identity());
        self.bounding_box = fitted.ok_or(SceneError::InvalidData)?;
        part.pose = Pose::identity();
        part.mesh = Rc::new(mesh);
        part.convex = false;
        Ok(())
    }
}

/// A tube around points, without the edges that are broken.
fn tube(points: &[[f64; 3]], radius: f64, broken: &[bool]) -> Mesh {
    let mut mesh = Mesh::default();
    let points: Vec<Vector3<f64>> = points.iter().map(|point| Vector3::from(*point)).collect();
    let mut first = 0;
    for end in 1..points.len() {
        if broken.get(end - 1).copied().unwrap_or(false) {
            add_tube(&points[first..end], radius, &mut mesh);
            first = end;
        }
    }
    add_tube(&points[first..], radius, &mut mesh);
    mesh
}

fn add_tube(points: &[Vector3<f64>], radius: f64, mesh: &mut Mesh) {
    let mut across: Option<Vector3<f64>> = None;
    for (index, point) in points.iter().enumerate() {
        let before = points[index.saturating_sub(1)];
        let after = points[(index + 1).min(points.len() - 1)];
        let Some(tangent) = (after - before).try_normalize(0.0) else {
            return;
        };
        // Carried along, so that the tube is not twisted.
        let known = across.and_then(|x| (x - tangent * tangent.dot(&x)).try_normalize(1e-6));
        let side = known.unwrap_or_else(|| {
            let mut axis = Vector3::zeros();
            axis[tangent.iamin()] = 1.0;
            tangent.cross(&axis).normalize()
        });
        across = Some(side);
        add_ring(
            *point,
            [side, tangent.cross(&side)],
            radius,
            index > 0,
            mesh,
        );
    }
    if points.len() > 1 {
        let count = mesh.vertices.len() as u32;
        let first = count - (points.len() * SIDES) as u32;
        add_cap(first, true, mesh);
        add_cap(count - SIDES as u32, false, mesh);
    }
}

fn add_ring(
    center: Vector3<f64>,
    across: [Vector3<f64>; 2],
    radius: f64,
    is_joined: bool,
    mesh: &mut Mesh,
) {
    let start = mesh.vertices.len() as u32;
    let count = SIDES as u32;
    for side in 0..count {
        let angle = 2.0 * std::f64::consts::PI * f64::from(side) / f64::from(count);
        let (sine, cosine) = libm::sincos(angle);
        let vertex = center + (across[0] * cosine + across[1] * sine) * radius;
        mesh.vertices.push(vertex.into());
        if is_joined {
            let next = (side + 1) % count;
            let [a, b] = [start - count + side, start - count + next];
            let [c, d] = [start + side, start + next];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
}

fn add_cap(start: u32, faces_back: bool, mesh: &mut Mesh) {
    for side in 1..SIDES as u32 - 1 {
        let [a, b] = [start + side, start + side + 1];
        mesh.triangles.push(if faces_back {
            [start, b, a]
        } else {
            [start, a, b]
        });
    }
}

#[cfg(test)]
mod tests;
