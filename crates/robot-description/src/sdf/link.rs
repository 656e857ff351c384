//! Links of an SDF model.

use bounded_xml::Node;

use super::value::{child_numbers, number, pose, text};
use crate::model::{
    Collision, Geometry, Inertial, Link, Material, Pose, Sensor, SensorKind, Visual,
};
use crate::xml::{Source, elements, named, short};

/// Reads a link; `folder` is what relative names of files are in.
pub fn read_link(source: &mut Source, node: Node, name: String, folder: &str) -> Link {
    let mut link = Link {
        name,
        line: source.line(node),
        ..Link::default()
    };
    link.inertial = source
        .child(node, "inertial")
        .map(|inertial| read_inertial(source, inertial));
    for visual in named(node, "visual") {
        let Some(geometry) = read_geometry(source, visual, folder) else {
            continue;
        };
        let (name, pose) = named_pose(source, visual);
        let material = source
            .child(visual, "material")
            .map(|material| read_material(source, material));
        link.visuals.push(Visual {
            name,
            pose,
            geometry,
            material,
            line: source.line(visual),
        });
    }
    for collision in named(node, "collision") {
        let Some(geometry) = read_geometry(source, collision, folder) else {
            continue;
        };
        let (name, pose) = named_pose(source, collision);
        link.collisions.push(Collision {
            name,
            pose,
            geometry,
            line: source.line(collision),
        });
    }
    link
}

/// The sensors of a link whose index is `link`.
pub fn read_sensors(source: &mut Source, node: Node, link: usize) -> Vec<Sensor> {
    let mut sensors = Vec::new();
    for sensor in named(node, "sensor") {
        let (name, pose) = named_pose(source, sensor);
        let kind = match sensor.attribute("type").unwrap_or_default() {
            "camera" | "depth" | "depth_camera" | "rgbd_camera" => read_camera(source, sensor),
            "ray" | "gpu_ray" | "lidar" | "gpu_lidar" | "sonar" => SensorKind::Ray,
            other => SensorKind::Other(other.to_owned()),
        };
        sensors.push(Sensor {
            name,
            link,
            pose,
            kind,
            line: source.line(sensor),
        });
    }
    sensors
}

fn named_pose(source: &mut Source, node: Node) -> (String, Pose) {
    let pose = pose(source, node);
    if let Some(text) = pose.as_ref().filter(|pose| !pose.relative_to.is_empty()) {
        source.warn(
            node,
            format!(
                "the frame '{}' of its pose is not looked at: the link's is taken",
                short(&text.relative_to)
            ),
        );
    }
    (
        node.attribute("name").unwrap_or_default().to_owned(),
        pose.map_or_else(Pose::identity, |text| text.pose),
    )
}

fn read_inertial(source: &mut Source, node: Node) -> Inertial {
    let pose = pose(source, node).map_or_else(Pose::identity, |text| text.pose);
    let mass = number(source, node, "mass").unwrap_or(1.0);
    // Without an inertia, or a part of it: that of the unit matrix, as the format says.
    let inertia = match source.child(node, "inertia") {
        Some(inertia) => {
            let mut moment =
                |name: &str, otherwise: f64| number(source, inertia, name).unwrap_or(otherwise);
            [
                moment("ixx", 1.0),
                moment("ixy", 0.0),
                moment("ixz", 0.0),
                moment("iyy", 1.0),
                moment("iyz", 0.0),
                moment("izz", 1.0),
            ]
        }
        None => [1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
    };
    Inertial {
        pose,
        mass,
        inertia,
    }
}

fn read_geometry(source: &mut Source, node: Node, folder: &str) -> Option<Geometry> {
    let Some(element) = source.child(node, "geometry") else {
        source.warn(node, "has no geometry; it is left out");
        return None;
    };
    let shape = elements(element).next()?;
    let mut size =
        |name: &str, otherwise: f64| number(source, shape, name).map_or(otherwise, f64::abs);
    Some(match shape.tag_name().name() {
        "box" => Geometry::Box {
            size: child_numbers(source, shape, "size", [1.0; 3]).map(f64::abs),
        },
        "sphere" => Geometry::Sphere {
            radius: size("radius", 1.0),
        },
        "cylinder" => Geometry::Cylinder {
            radius: size("radius", 1.0),
            length: size("length", 1.0),
        },
        "capsule" => Geometry::Capsule {
            radius: size("radius", 0.5),
            length: size("length", 1.0),
        },
        "ellipsoid" => Geometry::Ellipsoid {
            radii: child_numbers(source, shape, "radii", [1.0; 3]).map(f64::abs),
        },
        "plane" => Geometry::Plane {
            normal: child_numbers(source, shape, "normal", [0.0, 0.0, 1.0]),
        },
        "mesh" => read_mesh(source, shape, folder)?,
        "empty" => return None,
        other => {
            source.leave_out(
                shape,
                format!("the geometry '{}' is not read", short(other)),
            );
            return None;
        }
    })
}

fn read_mesh(source: &mut Source, node: Node, folder: &str) -> Option<Geometry> {
    let Some(uri) = text(source, node, "uri") else {
        source.warn(node, "has no uri; it is left out");
        return None;
    };
    if source.child(node, "submesh").is_some() {
        source.warn(node, "names a part of the file: all of it is taken");
    }
    let is_relative = !uri.contains("://") && !uri.starts_with('/');
    let file = if is_relative && !folder.is_empty() {
        format!("{folder}/{uri}")
    } else {
        uri
    };
    Some(Geometry::Mesh {
        file,
        scale: child_numbers(source, node, "scale", [1.0; 3]),
    })
}

fn read_material(source: &mut Source, node: Node) -> Material {
    let color = ["diffuse", "ambient"]
        .iter()
        .find_map(|name| source.child(node, name));
    let color = color.map(|color| super::value::numbers(source, color, [1.0; 4]));
    let script = source
        .child(node, "script")
        .and_then(|script| text(source, script, "name"));
    Material {
        name: script.unwrap_or_default(),
        color,
        texture: None,
    }
}

fn read_camera(source: &mut Source, node: Node) -> SensorKind {
    let camera = source.child(node, "camera").unwrap_or(node);
    let image = source.child(camera, "image").unwrap_or(camera);
    let clip = source.child(camera, "clip").unwrap_or(camera);
    let pixels = |number: Option<f64>, otherwise| {
        number.map_or(otherwise, |number| number.clamp(1.0, 65536.0) as u32)
    };
    let resolution = [
        pixels(number(source, image, "width"), 320),
        pixels(number(source, image, "height"), 240),
    ];
    let planes = [
        number(source, clip, "near").unwrap_or(0.1),
        number(source, clip, "far").unwrap_or(100.0),
    ];
    SensorKind::Camera {
        resolution,
        angle: number(source, camera, "horizontal_fov").unwrap_or(1.047),
        clip: planes,
    }
}
