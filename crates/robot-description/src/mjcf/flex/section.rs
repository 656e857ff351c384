//! The parts of composites: how thick their links are, and what is between them.

use std::f64::consts::PI;

use super::{Reader, Refusal, positive};
use crate::mjcf::attributes::Attributes;
use crate::mjcf::element::Element;
use crate::xml::short;

/// What the `<geom>` of a composite says.
#[derive(Debug, Clone, Copy)]
pub struct Section {
    /// Half sizes, or radius and half length, metres.
    size: [f64; 3],
    kind: Kind,
    density: f64,
    mass: Option<f64>,
    pub friction: f64,
    pub touches: bool,
    pub color: Option<[f64; 4]>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Sphere,
    Capsule,
    Cylinder,
    Box,
    Ellipsoid,
}

impl Section {
    pub fn read<'a>(
        reader: &mut Reader<'a>,
        element: &'a Element,
        default: &str,
    ) -> Result<Self, Refusal> {
        let empty = || "it has no <geom>".to_owned();
        let geom = reader.child(element, "geom").ok_or_else(empty)?;
        let kind = match geom.get("type").unwrap_or(default) {
            "sphere" => Kind::Sphere,
            "capsule" => Kind::Capsule,
            "cylinder" => Kind::Cylinder,
            "box" => Kind::Box,
            "ellipsoid" => Kind::Ellipsoid,
            other => return Err(format!("geoms of type '{}' are not read", short(other))),
        };
        let section = Self {
            size: geom.numbers(reader.report, "size", [0.0; 3]),
            kind,
            density: reader.number(&geom, "density", 1000.0),
            mass: geom.number(reader.report, "mass"),
            friction: reader.number(&geom, "friction", 1.0).clamp(0.0, 100.0),
            touches: reader.touches(&geom),
            color: reader.color(&geom),
        };
        positive("size", section.radius())?;
        Ok(section)
    }

    /// Area, and mean second moment of area: that of a circle, or of the rectangle of a box.
    pub fn area(&self) -> [f64; 2] {
        let [r, y, z] = self.size;
        if self.kind == Kind::Box {
            return [4.0 * y * z, 2.0 / 3.0 * y * z * (y * y + z * z)];
        }
        [PI * r * r, 0.25 * PI * r.powi(4)]
    }

    pub fn radius(&self) -> f64 {
        let [r, y, z] = self.size;
        match self.kind {
            Kind::Box => 0.5 * (y + z),
            Kind::Ellipsoid => libm::cbrt(r * y * z),
            _ => r,
        }
    }

    pub fn is_box(&self) -> bool {
        self.kind == Kind::Box
    }

    /// Mass of a link of a cable of that length.
    pub fn mass_of_length(&self, length: f64) -> f64 {
        let ends = if self.kind == Kind::Capsule {
            4.0 / 3.0 * PI * self.size[0].powi(3)
        } else {
            0.0
        };
        self.mass
            .unwrap_or_else(|| self.density * (self.area()[0] * length + ends))
    }

    /// Mass of a node with that geom as it is.
    pub fn mass_of_node(&self) -> f64 {
        let [x, y, z] = self.size;
        let ball = 4.0 / 3.0 * PI;
        let volume = match self.kind {
            Kind::Sphere => ball * x.powi(3),
            Kind::Capsule => ball * x.powi(3) + 2.0 * PI * x * x * y,
            Kind::Cylinder => 2.0 * PI * x * x * y,
            Kind::Box => 8.0 * x * y * z,
            Kind::Ellipsoid => ball * x * y * z,
        };
        self.mass.unwrap_or(self.density * volume)
    }
}

/// The first child of that name whose `kind` is the given one.
pub fn of_kind<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    name: &'a str,
    kind: &str,
) -> Option<Attributes<'a>> {
    let mut named = element.named(name);
    let found = named.find(|child| child.attribute("kind").is_none_or(|own| own == kind))?;
    Some(reader.attributes(found))
}
