//! Links of a URDF file, and what is on them.

use bounded_xml::Node;
use nalgebra::Translation3;

use crate::model::{
    Collision, Geometry, Inertial, Link, Material, Pose, Sensor, SensorKind, Visual,
};
use crate::positions::from_rpy;
use crate::xml::{Source, elements, named, short};

/// What a link may contain; contact and audio are Bullet's.
const KNOWN: &[&str] = &[
    "inertial",
    "visual",
    "collision",
    "contact",
    "self_collision_checking",
    "audio_source",
];

pub fn read_link(source: &mut Source, node: Node) -> Link {
    source.expect_children(node, KNOWN);
    let mut link = Link {
        name: source.required(node, "name"),
        line: source.line(node),
        ..Link::default()
    };
    link.inertial = source
        .child(node, "inertial")
        .map(|inertial| read_inertial(source, inertial));
    for visual in named(node, "visual") {
        source.expect_children(visual, &["origin", "geometry", "material"]);
        let Some(geometry) = read_geometry(source, visual) else {
            continue;
        };
        let (name, pose) = (name_of(visual), read_origin(source, visual));
        let material = source
            .child(visual, "material")
            .and_then(|material| read_material(source, material));
        link.visuals.push(Visual {
            name,
            pose,
            geometry,
            material,
            line: source.line(visual),
        });
    }
    for collision in named(node, "collision") {
        source.expect_children(
            collision,
            &["origin", "geometry", "verbose", "contact_coefficients"],
        );
        let Some(geometry) = read_geometry(source, collision) else {
            continue;
        };
        let (name, pose) = (name_of(collision), read_origin(source, collision));
        link.collisions.push(Collision {
            name,
            pose,
            geometry,
            line: source.line(collision),
        });
    }
    link
}

fn name_of(node: Node) -> String {
    node.attribute("name").unwrap_or_default().to_owned()
}

/// The `<origin>` inside of an element.
pub fn read_origin(source: &mut Source, node: Node) -> Pose {
    let Some(origin) = source.child(node, "origin") else {
        return Pose::identity();
    };
    let [x, y, z] = source.numbers(origin, "xyz", [0.0; 3]);
    let rpy = source.numbers(origin, "rpy", [0.0; 3]);
    Pose::from_parts(Translation3::new(x, y, z), from_rpy(rpy))
}

fn read_inertial(source: &mut Source, node: Node) -> Inertial {
    source.expect_children(node, &["origin", "mass", "inertia"]);
    let pose = read_origin(source, node);
    let mass = match source.child(node, "mass") {
        Some(mass) => source.number(mass, "value"),
        None => None,
    };
    if mass.is_none() {
        source.warn(node, "has no mass");
    }
    let inertia = match source.child(node, "inertia") {
        Some(inertia) => ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
            .map(|name| source.number(inertia, name).unwrap_or(0.0)),
        None => {
            source.warn(node, "has no inertia");
            [0.0; 6]
        }
    };
    Inertial {
        pose,
        mass: mass.unwrap_or(0.0),
        inertia,
    }
}

fn read_geometry(source: &mut Source, node: Node) -> Option<Geometry> {
    let Some(element) = source.child(node, "geometry") else {
        source.warn(node, "has no geometry; it is left out");
        return None;
    };
    let mut found = None;
    for shape in elements(element) {
        let geometry = read_shape(source, shape);
        if found.is_some() && geometry.is_some() {
            source.warn(shape, "there is a geometry before it, which counts");
        } else {
            found = found.or(geometry);
        }
    }
    if elements(element).next().is_none() {
        source.warn(element, "is empty; it is left out");
    }
    found
}

fn read_shape(source: &mut Source, node: Node) -> Option<Geometry> {
    let geometry = match node.tag_name().name() {
        "box" => Geometry::Box {
            size: source.numbers(node, "size", [0.0; 3]).map(f64::abs),
        },
        "sphere" => Geometry::Sphere {
            radius: length(source, node, "radius"),
        },
        "cylinder" => Geometry::Cylinder {
            radius: length(source, node, "radius"),
            length: length(source, node, "length"),
        },
        "capsule" => Geometry::Capsule {
            radius: length(source, node, "radius"),
            length: length(source, node, "length"),
        },
        "ellipsoid" => Geometry::Ellipsoid {
            radii: source.numbers(node, "radii", [0.0; 3]).map(f64::abs),
        },
        "plane" => Geometry::Plane {
            normal: source.numbers(node, "normal", [0.0, 0.0, 1.0]),
        },
        "mesh" => read_mesh(source, node)?,
        other => {
            source.leave_out(
                node,
                format!("the geometry '{}' is not known", short(other)),
            );
            return None;
        }
    };
    Some(geometry)
}

fn length(source: &mut Source, node: Node, attribute: &str) -> f64 {
    let value = source.number(node, attribute).map(f64::abs);
    if value.is_none() {
        source.warn(node, format!("has no {attribute}"));
    }
    value.unwrap_or(0.0)
}

fn read_mesh(source: &mut Source, node: Node) -> Option<Geometry> {
    let file = source.required(node, "filename");
    if file.is_empty() {
        return None;
    }
    // One number is a factor for all axes, as in other formats.
    let scale = match node
        .attribute("scale")
        .map(|text| text.split_whitespace().count())
    {
        Some(1) => [source.number(node, "scale").unwrap_or(1.0); 3],
        _ => source.numbers(node, "scale", [1.0; 3]),
    };
    Some(Geometry::Mesh { file, scale })
}

/// A material; one that is written inside of another one stands for it.
pub fn read_material(source: &mut Source, node: Node) -> Option<Material> {
    source.expect_children(node, &["color", "texture", "material"]);
    let inner = source.child(node, "material");
    let element = match inner {
        Some(inner) => {
            source.warn(
                inner,
                "a material inside of a material; the inner one counts",
            );
            inner
        }
        None => node,
    };
    let mut color = None;
    if let Some(child) = source.child(element, "color")
        && child.has_attribute("rgba")
    {
        color = Some(source.numbers(child, "rgba", [0.5, 0.5, 0.5, 1.0]));
    }
    let texture = source
        .child(element, "texture")
        .and_then(|texture| texture.attribute("filename"))
        .map(str::to_owned);
    let name = element
        .attribute("name")
        .or(node.attribute("name"))
        .unwrap_or_default()
        .to_owned();
    Some(Material {
        name,
        color,
        texture,
    })
}

/// A sensor (<https://wiki.ros.org/urdf/XML/sensor>), if its link is there.
pub fn read_sensor(
    source: &mut Source,
    node: Node,
    link: impl Fn(&str) -> Option<usize>,
) -> Option<Sensor> {
    let parent = source
        .child(node, "parent")
        .and_then(|parent| parent.attribute("link"))
        .unwrap_or_default();
    let Some(link) = link(parent) else {
        source.warn(
            node,
            format!(
                "there is no link '{}' for it; it is left out",
                short(parent)
            ),
        );
        return None;
    };
    let kind = if let Some(camera) = source.child(node, "camera") {
        read_camera(source, camera)
    } else if elements(node).any(|child| matches!(child.tag_name().name(), "ray" | "proximity")) {
        SensorKind::Ray
    } else {
        SensorKind::Other(node.attribute("type").unwrap_or_default().to_owned())
    };
    Some(Sensor {
        name: name_of(node),
        link,
        pose: read_origin(source, node),
        kind,
        line: source.line(node),
    })
}

fn read_camera(source: &mut Source, node: Node) -> SensorKind {
    let image = source.child(node, "image").unwrap_or(node);
    let pixels = |number: Option<f64>, otherwise| {
        number.map_or(otherwise, |number| number.clamp(1.0, 65536.0) as u32)
    };
    let resolution = [
        pixels(source.number(image, "width"), 640),
        pixels(source.number(image, "height"), 480),
    ];
    let angle = source
        .number(image, "hfov")
        .unwrap_or(std::f64::consts::FRAC_PI_3);
    let clip = [
        source.number(image, "near").unwrap_or(0.01),
        source.number(image, "far").unwrap_or(10.0),
    ];
    SensorKind::Camera {
        resolution,
        angle,
        clip,
    }
}
