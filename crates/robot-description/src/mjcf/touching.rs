//! Which bodies may touch: `contype` and `conaffinity` of their geoms, neighbours in the tree, and what `<contact>` says of pairs.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::attributes::{Attributes, MAIN};
use super::body::Builder;
use super::document::Document;
use super::element::{Element, Report};
use crate::model::{Geometry, Names, Pose};
use crate::xml::short;

/// Of more bodies that are touched it is not said which of them may touch each other.
const MOST_BODIES: usize = 512;

/// A geom that may touch others.
pub struct TouchingGeom {
    pub link: usize,
    /// Its place in the collisions of its link.
    pub part: usize,
    pub name: String,
    pub bits: Bits,
}

/// `contype` and `conaffinity`: two geoms touch where one's first has a bit of the other's second.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Bits(pub [i64; 2]);

impl Bits {
    pub const NONE: Self = Self([0, 0]);

    fn may_touch(self, other: Self) -> bool {
        self.0[0] & other.0[1] != 0 || other.0[0] & self.0[1] != 0
    }
}

/// Where a body is in the tree.
#[derive(Debug, Clone, Copy, Default)]
pub struct BodyPlace {
    /// The first of the bodies that are fixed to each other.
    pub rigid: usize,
    /// The body, of those that are fixed to each other the first, that this one hangs on; 0 is the world.
    pub parent: usize,
}

/// What `<contact>` says of pairs.
#[derive(Debug, Default)]
pub struct Pairs<'a> {
    /// Bodies that do not touch, with their elements.
    excluded: Vec<(&'a Element, [&'a str; 2])>,
    /// Geoms that touch whatever their bits are.
    touching: Vec<(&'a Element, [&'a str; 2])>,
    named: BTreeSet<&'a str>,
    /// Whether neighbours in the tree touch as others do.
    neighbours_touch: bool,
}

impl<'a> Pairs<'a> {
    pub fn new(root: &'a Element, report: &mut Report) -> Self {
        let flags = root.named("option").flat_map(|option| option.named("flag"));
        let mut pairs = Self {
            neighbours_touch: flags
                .filter_map(|flag| flag.attribute("filterparent"))
                .last()
                .is_some_and(|value| value == "disable"),
            ..Self::default()
        };
        for element in root.named("contact").flat_map(|part| &part.children) {
            let names =
                |keys: [&str; 2]| keys.map(|key| element.attribute(key).unwrap_or_default());
            match element.name.as_str() {
                "exclude" => pairs.excluded.push((element, names(["body1", "body2"]))),
                "pair" => {
                    let names = names(["geom1", "geom2"]);
                    pairs.named.extend(names);
                    pairs.touching.push((element, names));
                }
                other => report.leave_out(element, format!("<{}> is not read", short(other))),
            }
        }
        pairs
    }

    /// Whether a geom is in a pair that touches whatever its bits are.
    pub fn has_geom(&self, name: &str) -> bool {
        !name.is_empty() && self.named.contains(name)
    }
}

/// The pairs of bodies that touch, or do not, whatever their geoms say.
struct Said {
    excluded: BTreeSet<[usize; 2]>,
    touching: BTreeSet<[usize; 2]>,
}

impl Builder<'_> {
    /// Leaves away what touches nothing that moves: rails that a cart is drawn on. What moves may touch what is not in the file.
    pub(super) fn leave_out_untouched(&mut self) {
        let is_fixed = |geom: &TouchingGeom| self.model.fixed.binary_search(&geom.link).is_ok();
        let (fixed, moving): (Vec<_>, Vec<_>) = std::mem::take(&mut self.touching)
            .into_iter()
            .partition(is_fixed);
        let bits: BTreeSet<Bits> = moving.iter().map(|geom| geom.bits).collect();
        let is_touched = |geom: &TouchingGeom| {
            bits.is_empty()
                || self.pairs.has_geom(&geom.name)
                || bits.iter().any(|bits| geom.bits.may_touch(*bits))
        };
        // From the last on, so that places stay what they are.
        for geom in fixed.iter().rev().filter(|geom| !is_touched(geom)) {
            self.model.robot.links[geom.link]
                .collisions
                .remove(geom.part);
        }
        self.touching = moving;
        self.touching.extend(fixed.into_iter().filter(is_touched));
    }

    /// Finds the pairs of links that may touch.
    pub(super) fn find_touching_pairs(&mut self) {
        let mut bits: BTreeMap<usize, BTreeSet<Bits>> = BTreeMap::new();
        for geom in &self.touching {
            bits.entry(geom.link).or_default().insert(geom.bits);
        }
        if bits.len() > MOST_BODIES {
            return;
        }
        let said = self.said_pairs();
        let links: Vec<(&usize, &BTreeSet<Bits>)> = bits.iter().collect();
        let mut pairs = Vec::new();
        for (number, (a, first)) in links.iter().enumerate() {
            for (b, second) in &links[number + 1..] {
                let pair = [**a, **b];
                if said.touching.contains(&pair)
                    || !said.excluded.contains(&pair)
                        && self.are_apart_in_tree(pair)
                        && all_touch(first, second)
                {
                    pairs.push(pair);
                }
            }
        }
        self.model.touching = Some(pairs);
    }

    /// Whether two bodies are neither fixed to each other nor neighbours in the tree; what hangs on the world touches it.
    fn are_apart_in_tree(&self, pair: [usize; 2]) -> bool {
        let [a, b] = pair.map(|link| self.places.get(&link).copied().unwrap_or_default());
        let hangs_on =
            |a: BodyPlace, b: BodyPlace| a.rigid != 0 && a.parent == b.rigid && b.rigid != 0;
        let are_neighbours = hangs_on(a, b) || hangs_on(b, a);
        a.rigid != b.rigid && (self.pairs.neighbours_touch || !are_neighbours)
    }

    fn said_pairs(&mut self) -> Said {
        let links = Names::new(self.model.robot.links.iter().map(|link| link.name.as_str()));
        let geoms = Names::new(self.touching.iter().map(|geom| geom.name.as_str()));
        let geom_link = |name: &str| geoms.get(name).map(|geom| self.touching[geom].link);
        let mut report = std::mem::take(&mut self.report);
        let mut found =
            |kind: &str, said: &[(&Element, [&str; 2])], find: &dyn Fn(&str) -> Option<usize>| {
                let pairs = said.iter().filter_map(|(element, names)| {
                    let missing = names.iter().find(|name| find(name).is_none());
                    if let Some(name) = missing {
                        report.leave_out(element, format!("there is no {kind} '{}'", short(name)));
                    }
                    Some(sorted([find(names[0])?, find(names[1])?]))
                });
                pairs.collect()
            };
        let said = Said {
            excluded: found("body", &self.pairs.excluded, &|name| links.get(name)),
            touching: found("geom that is touched", &self.pairs.touching, &geom_link),
        };
        let frictions = self.pairs.touching.iter().filter_map(|(element, names)| {
            let [a, b] = [geom_link(names[0])?, geom_link(names[1])?];
            let friction = friction_of_pair(self.document, element, &mut report)?;
            Some((sorted([a, b]), friction))
        });
        self.model.pair_frictions = frictions.collect();
        self.report = report;
        said
    }
}

/// The friction of a `<pair>`, if it says one; a pair of one dimension has none.
fn friction_of_pair(document: &Document, element: &Element, report: &mut Report) -> Option<f64> {
    let attributes = document.defaults.of(element, MAIN, report);
    if attributes.get("condim") == Some("1") {
        return Some(0.0);
    }
    let friction = attributes.number(report, "friction")?;
    Some(friction.max(0.0))
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Whether every geom of a body may touch every one of another body; those that are touched in pairs alone do not matter.
fn all_touch(first: &BTreeSet<Bits>, second: &BTreeSet<Bits>) -> bool {
    let counting = |bits: &BTreeSet<Bits>| -> Vec<Bits> {
        bits.iter()
            .copied()
            .filter(|bits| *bits != Bits::NONE)
            .collect()
    };
    let (first, second) = (counting(first), counting(second));
    let all = first.iter().all(|a| second.iter().all(|b| a.may_touch(*b)));
    all && !first.is_empty() && !second.is_empty()
}

/// A geom as others touch it: larger by its margin, by which MuJoCo keeps others away from it. A mesh stays as it is. A plane has no end, wherever its centre is: it is
/// where it is nearest to the frame of its body.
pub fn as_touched(
    attributes: &Attributes,
    report: &mut Report,
    pose: Pose,
    geometry: &Geometry,
) -> (Pose, Geometry) {
    let margin = attributes.number(report, "margin").unwrap_or(0.0).max(0.0);
    if let Geometry::Plane { normal } = geometry {
        let up = pose.rotation * Vector3::from(*normal);
        let height = pose.translation.vector.dot(&up) + margin;
        let nearest = Pose::from_parts((up * height).into(), pose.rotation);
        return (nearest, geometry.clone());
    }
    (pose, grown(geometry, margin))
}

fn grown(geometry: &Geometry, margin: f64) -> Geometry {
    match geometry.clone() {
        Geometry::Sphere { radius } => Geometry::Sphere {
            radius: radius + margin,
        },
        Geometry::Capsule { radius, length } => Geometry::Capsule {
            radius: radius + margin,
            length,
        },
        Geometry::Cylinder { radius, length } => Geometry::Cylinder {
            radius: radius + margin,
            length: length + 2.0 * margin,
        },
        Geometry::Box { size } => Geometry::Box {
            size: size.map(|length| length + 2.0 * margin),
        },
        Geometry::Ellipsoid { radii } => Geometry::Ellipsoid {
            radii: radii.map(|radius| radius + margin),
        },
        same @ (Geometry::Plane { .. } | Geometry::Mesh { .. }) => same,
    }
}
