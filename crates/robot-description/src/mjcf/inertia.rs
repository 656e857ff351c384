//! The masses of bodies: as written, or of their geoms.

use std::f64::consts::PI;

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::Files;
use super::attributes::Attributes;
use super::body::Builder;
use super::document::FromGeoms;
use super::element::{Element, MAX_NUMBER};
use super::mesh_solid::{self, Solid, Volume};
use crate::model::{Geometry, Inertial, Pose};
use crate::xml::short;

/// What a geom adds to the mass of its body.
#[derive(Debug)]
pub struct Weighed {
    /// In the link's frame.
    pub pose: Pose,
    pub geometry: Geometry,
    pub mass: Mass,
    /// Of a mesh.
    pub volume: Volume,
    pub line: u32,
}

/// What a file says about a mass.
#[derive(Debug, Clone, Copy)]
pub enum Mass {
    /// kg
    Total(f64),
    /// kg/m³
    Density(f64),
}

impl Builder<'_> {
    /// The mass of a body: what its `<inertial>` says, or the sum of its geoms.
    pub(super) fn inertial(
        &mut self,
        body: &Element,
        said: Option<Inertial>,
        geoms: &[Weighed],
    ) -> Option<Inertial> {
        match self.document.settings.inertia_from_geoms {
            FromGeoms::None => said,
            FromGeoms::WithoutInertial if said.is_some() => said,
            _ => self.sum(body, geoms),
        }
    }

    /// An `<inertial>` in a link's frame.
    pub(super) fn read_inertial(&mut self, attributes: &Attributes, place: Pose) -> Inertial {
        let pose = place * self.document.pose(attributes, &mut self.report);
        let mass = attributes.number(&mut self.report, "mass").unwrap_or(0.0);
        let full = attributes.get("fullinertia").is_some();
        let inertia = if full {
            let [xx, yy, zz, xy, xz, yz] =
                attributes.numbers(&mut self.report, "fullinertia", [0.0; 6]);
            [xx, xy, xz, yy, yz, zz]
        } else {
            let [xx, yy, zz] = attributes.numbers(&mut self.report, "diaginertia", [0.0; 3]);
            [xx, 0.0, 0.0, yy, 0.0, zz]
        };
        Inertial {
            pose,
            mass,
            inertia,
        }
    }

    fn sum(&mut self, body: &Element, geoms: &[Weighed]) -> Option<Inertial> {
        let mut parts = Vec::new();
        for geom in geoms {
            match solid(geom, self.files) {
                Ok(solid) => parts.extend(placed(geom, &solid)),
                Err(reason) => {
                    let text = format!("the mass of the geom in line {}: {reason}", geom.line);
                    self.report.warn(body, short(&text));
                }
            }
        }
        let mass: f64 = parts.iter().map(|(mass, ..)| mass).sum();
        if mass <= 0.0 {
            return None;
        }
        let centre = parts
            .iter()
            .map(|(part, centre, _)| centre * *part)
            .sum::<Vector3<f64>>()
            / mass;
        let about_centre = |(mass, at, inertia): &(f64, Vector3<f64>, Matrix3<f64>)| {
            let d = at - centre;
            inertia + (Matrix3::from_diagonal_element(d.norm_squared()) - d * d.transpose()) * *mass
        };
        let inertia: Matrix3<f64> = parts.iter().map(about_centre).sum();
        Some(Inertial {
            pose: nalgebra::Translation3::from(centre).into(),
            mass,
            inertia: upper(&inertia),
        })
    }

    /// Applies what the settings say about the masses of all bodies.
    pub fn finish_masses(&mut self, root: &Element) {
        let settings = &self.document.settings;
        let total = self.model.robot.mass();
        let mut factor = settings
            .total_mass
            .filter(|_| total > 0.0)
            .map_or(1.0, |wanted| wanted / total);
        if factor > MAX_NUMBER {
            self.report.warn(
                root,
                format!("the bodies weigh {total:e} kg, too little to be scaled to the total mass"),
            );
            factor = 1.0;
        }
        let (least_mass, least_inertia, balances) = (
            settings.least_mass,
            settings.least_inertia,
            settings.balances_inertia,
        );
        for inertial in self
            .model
            .robot
            .links
            .iter_mut()
            .filter_map(|link| link.inertial.as_mut())
        {
            inertial.mass = inertial.mass.max(least_mass);
            if least_inertia > 0.0 || balances {
                inertial.inertia = bounded(inertial.inertia, least_inertia, balances);
            }
            inertial.mass *= factor;
            inertial.inertia = inertial.inertia.map(|number| number * factor);
        }
    }
}

/// An inertia whose moments have a least value; those that no body has are made equal.
fn bounded(inertia: [f64; 6], least: f64, balances: bool) -> [f64; 6] {
    let Some(eigen) = SymmetricEigen::try_new(full(inertia), f64::EPSILON, 1000) else {
        return inertia;
    };
    let mut moments = eigen.eigenvalues.map(|moment| moment.max(least));
    let largest = moments.max();
    if balances && moments.sum() < 2.0 * largest {
        moments = Vector3::repeat(moments.sum() / 3.0);
    }
    let axes = eigen.eigenvectors;
    upper(&(axes * Matrix3::from_diagonal(&moments) * axes.transpose()))
}

fn full([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn upper(matrix: &Matrix3<f64>) -> [f64; 6] {
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|place| matrix[place])
}

/// Mass, centre and inertia about it in the link's frame.
fn placed(geom: &Weighed, solid: &Solid) -> Option<(f64, Vector3<f64>, Matrix3<f64>)> {
    let density = match geom.mass {
        Mass::Density(density) => density,
        Mass::Total(mass) if solid.volume > 0.0 => mass / solid.volume,
        Mass::Total(_) => return None,
    };
    let mass = solid.volume * density;
    if !(mass > 0.0 && mass.is_finite()) {
        return None;
    }
    let turn = geom.pose.rotation.to_rotation_matrix();
    let centre = geom.pose.transform_point(&solid.centre.into()).coords;
    Some((
        mass,
        centre,
        turn * (solid.inertia * density) * turn.transpose(),
    ))
}

/// The solid of a geom, at a density of 1.
fn solid(geom: &Weighed, files: &mut dyn Files) -> Result<Solid, String> {
    if let Geometry::Mesh { file, scale } = &geom.geometry {
        let mesh = files.triangles(file)?;
        return mesh_solid::solid(&mesh, *scale, geom.volume)
            .ok_or_else(|| format!("'{file}' has no volume"));
    }
    let (volume, moments) = volume_and_moments(&geom.geometry);
    Ok(Solid {
        volume,
        centre: Vector3::zeros(),
        inertia: Matrix3::from_diagonal(&moments.into()),
    })
}

fn volume_and_moments(geometry: &Geometry) -> (f64, [f64; 3]) {
    match geometry {
        Geometry::Plane { .. } | Geometry::Mesh { .. } => (0.0, [0.0; 3]),
        Geometry::Sphere { radius } => {
            let volume = 4.0 / 3.0 * PI * radius * radius * radius;
            (volume, [0.4 * volume * radius * radius; 3])
        }
        Geometry::Ellipsoid { radii } => {
            let [a, b, c] = radii.map(|radius| radius * radius);
            let volume = 4.0 / 3.0 * PI * radii.iter().product::<f64>();
            (volume, [b + c, a + c, a + b].map(|sum| 0.2 * volume * sum))
        }
        Geometry::Box { size } => {
            let [a, b, c] = size.map(|size| size * size);
            let volume: f64 = size.iter().product();
            (volume, [b + c, a + c, a + b].map(|sum| volume * sum / 12.0))
        }
        Geometry::Cylinder { radius, length } => {
            let volume = PI * radius * radius * length;
            let across = volume * (3.0 * radius * radius + length * length) / 12.0;
            (volume, [across, across, 0.5 * volume * radius * radius])
        }
        Geometry::Capsule { radius, length } => capsule(*radius, *length),
    }
}

/// Volume and moments of a cylinder with half a ball at each end.
fn capsule(r: f64, l: f64) -> (f64, [f64; 3]) {
    let (cylinder, balls) = (PI * r * r * l, 4.0 / 3.0 * PI * r * r * r);
    let along = 0.5 * cylinder * r * r + 0.4 * balls * r * r;
    let across = cylinder * (3.0 * r * r + l * l) / 12.0
        + balls * (0.4 * r * r + 0.375 * r * l + 0.25 * l * l);
    (cylinder + balls, [across, across, along])
}
