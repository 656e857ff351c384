//! Geoms: what they look like, what touches them, what they weigh.

use nalgebra::Vector3;

use super::attributes::Attributes;
use super::body::{Builder, Place};
use super::inertia::{Mass, Weighed};
use super::orientation::along;
use super::touching::{Bits, TouchingGeom, as_touched};
use crate::model::{Collision, Geometry, Pose, Visual};
use crate::xml::short;

/// kg/m³ of what says nothing else.
const DENSITY: f64 = 1000.0;
/// Coulomb's friction of what says nothing else.
const FRICTION: f64 = 1.0;
/// Geoms of groups above are not shown.
const LAST_VISIBLE_GROUP: f64 = 2.0;

impl Builder<'_> {
    /// Adds a geom to its link. The result is what it adds to the mass of the body.
    pub(super) fn add_geom(&mut self, attributes: &Attributes, place: &Place) -> Option<Weighed> {
        let (pose, geometry) = self.geometry(attributes)?;
        let pose = place.pose * pose;
        let name = attributes.get("name").unwrap_or_default().to_owned();
        let line = attributes.element.line;
        let mut number = |name: &str, otherwise: f64| {
            attributes
                .number(&mut self.report, name)
                .unwrap_or(otherwise)
        };
        let group = number("group", 0.0);
        let bits = ["contype", "conaffinity"].map(|name| number(name, 1.0) as i64);
        let bits = Bits(bits);
        let touches = bits != Bits::NONE || self.pairs.has_geom(&name);
        let density = number("density", DENSITY);
        let friction = number("friction", FRICTION);
        let mass = attributes.number(&mut self.report, "mass");
        if attributes.get("fluidshape") == Some("ellipsoid") {
            let text = "fluidshape is not read: the fluid slows the box of the body's inertia down";
            self.report.leave_out(attributes.element, text);
        }
        let material = self.document.material(attributes, &mut self.report);
        let (touched_pose, touched) = as_touched(attributes, &mut self.report, pose, &geometry);
        if touches {
            self.note_motion(attributes, place.link, &pose);
        }
        let link = &mut self.model.robot.links[place.link];
        if touches {
            let part = link.collisions.len();
            self.touching.push(TouchingGeom {
                link: place.link,
                part,
                name: name.clone(),
                bits,
            });
            link.friction = Some(link.friction.unwrap_or(0.0).max(friction));
            link.collisions.push(Collision {
                name: name.clone(),
                pose: touched_pose,
                geometry: touched,
                line,
            });
        }
        if group <= LAST_VISIBLE_GROUP {
            link.visuals.push(Visual {
                name,
                pose,
                geometry: geometry.clone(),
                material,
                line,
            });
        }
        let [low, high] = self.document.settings.inertia_groups;
        let mass = mass.map_or(Mass::Density(density), Mass::Total);
        let volume = attributes
            .get("mesh")
            .and_then(|mesh| self.document.meshes.get(mesh))
            .map(|mesh| mesh.volume);
        let volume = volume.unwrap_or_default();
        (low..=high).contains(&group).then_some(Weighed {
            pose,
            geometry,
            mass,
            volume,
            line,
        })
    }

    /// The geometry of a geom, and where it is in the frame that the geom is in.
    fn geometry(&mut self, attributes: &Attributes) -> Option<(Pose, Geometry)> {
        let mesh = attributes.get("mesh");
        let kind = attributes
            .get("type")
            .unwrap_or(if mesh.is_some() { "mesh" } else { "sphere" });
        let pose = self.document.pose(attributes, &mut self.report);
        if let Some(mesh) = mesh {
            return self.mesh(attributes, kind, mesh, pose);
        }
        let (pose, half) = self.placed(attributes, pose);
        let size = self.size(attributes, kind, half)?;
        Some((
            pose,
            match kind {
                "sphere" => Geometry::Sphere { radius: size[0] },
                "capsule" => Geometry::Capsule {
                    radius: size[0],
                    length: 2.0 * size[1],
                },
                "cylinder" => Geometry::Cylinder {
                    radius: size[0],
                    length: 2.0 * size[1],
                },
                "ellipsoid" => Geometry::Ellipsoid { radii: size },
                "box" => Geometry::Box {
                    size: size.map(|half| 2.0 * half),
                },
                "plane" => Geometry::Plane {
                    normal: [0.0, 0.0, 1.0],
                },
                other => {
                    self.report.leave_out(
                        attributes.element,
                        format!("a geom of type '{}' is not read", short(other)),
                    );
                    return None;
                }
            },
        ))
    }

    /// Of a geom between two points: its pose, and half of its length.
    fn placed(&mut self, attributes: &Attributes, pose: Pose) -> (Pose, Option<f64>) {
        let Some(ends) = attributes.list(&mut self.report, "fromto") else {
            return (pose, None);
        };
        let [x0, y0, z0, x1, y1, z1] = ends[..] else {
            self.report.warn(
                attributes.element,
                "fromto has no six numbers; it is left out",
            );
            return (pose, None);
        };
        let (from, to) = (Vector3::new(x0, y0, z0), Vector3::new(x1, y1, z1));
        // MuJoCo's z axis points from the second point to the first.
        let rotation = along(from - to).unwrap_or_default();
        (
            Pose::from_parts(((from + to) / 2.0).into(), rotation),
            Some((to - from).norm() / 2.0),
        )
    }

    /// The numbers of a size; half of the length is known if the geom is between two points.
    fn size(&mut self, attributes: &Attributes, kind: &str, half: Option<f64>) -> Option<[f64; 3]> {
        let needed = match kind {
            "sphere" => 1,
            "capsule" | "cylinder" => 2,
            "box" | "ellipsoid" => 3,
            _ => return Some([0.0; 3]),
        };
        let mut size = attributes
            .list(&mut self.report, "size")
            .unwrap_or_default();
        if let Some(half) = half {
            match kind {
                "capsule" | "cylinder" => size = vec![size.first().copied().unwrap_or(0.0), half],
                "box" | "ellipsoid" => {
                    let across = size.first().copied().unwrap_or(0.0);
                    size = vec![
                        across,
                        size.get(1)
                            .copied()
                            .filter(|size| *size > 0.0)
                            .unwrap_or(across),
                        half,
                    ];
                }
                _ => {}
            }
        }
        if size.len() < needed || size[..needed].iter().any(|size| *size <= 0.0) {
            let found = if size.len() < needed {
                "too few sizes"
            } else {
                "a size that is not positive"
            };
            self.report.leave_out(
                attributes.element,
                format!("a {} with {found}; it is left out", short(kind)),
            );
            return None;
        }
        Some(std::array::from_fn(|i| size.get(i).copied().unwrap_or(0.0)))
    }

    fn mesh(
        &mut self,
        attributes: &Attributes,
        kind: &str,
        name: &str,
        pose: Pose,
    ) -> Option<(Pose, Geometry)> {
        if kind != "mesh" {
            self.report.warn(
                attributes.element,
                format!(
                    "a {} is not fitted to its mesh: the mesh is taken",
                    short(kind)
                ),
            );
        }
        let Some(asset) = self.document.meshes.get(name) else {
            self.report.leave_out(
                attributes.element,
                format!("there is no mesh '{}'", short(name)),
            );
            return None;
        };
        Some((
            pose * asset.reference.inverse(),
            Geometry::Mesh {
                file: asset.file.clone(),
                scale: asset.scale,
            },
        ))
    }
}
