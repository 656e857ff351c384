//! Properties of display objects: lights, graphs, octrees and point clouds.

use geometry::Finite;

use super::Color;
use super::access::{Accessor, length, object_properties, refused};
use crate::binding::args::Bytes;
use scene::graph::Graph;

pub(in crate::property) const LIGHT: &[Accessor] = object_properties! {
    "lightSize": f64, |o| o.light()?.size, Appearance |o, size| o.light_mut()?.size = length(size)?;
    "enabled": bool, |o| o.light()?.enabled, Appearance |o, on| o.light_mut()?.enabled = on;
    "lightType": i64, |o| o.light()?.light_type.code();
    "spotExponent": i64, |o| o.light()?.spot_exponent,
        Appearance |o, exponent| o.light_mut()?.spot_exponent = exponent.clamp(0, 100);
    "spotCutoffAngle": f64, |o| o.light()?.spot_cutoff,
        Appearance |o, angle| {
            o.light_mut()?.spot_cutoff = angle.finite().ok_or_else(refused)?.clamp(0.0, std::f64::consts::FRAC_PI_2);
        };
    "attenuationFactors": Vec<f64>, |o| o.light()?.attenuation.to_vec(), Appearance |o, factors| {
        let factors: &[f64; 3] = factors.first_chunk().ok_or_else(refused)?;
        o.light_mut()?.attenuation = *factors;
    };
    "povray.castShadows": bool, |o| o.light()?.casts_shadows, Appearance |o, on| o.light_mut()?.casts_shadows = on;
};

pub(in crate::property) const GRAPH: &[Accessor] = object_properties! {
    "graphSize": f64, |o| o.graph()?.size, Appearance |o, size| o.graph_mut()?.size = length(size)?;
    "bufferSize": i64, |o| o.graph()?.buffer_size,
        Other |o, size| o.graph_mut()?.buffer_size = size.clamp(1, Graph::MAX_BUFFER_SIZE);
    "cyclic": bool, |o| o.graph()?.cyclic, Other |o, on| o.graph_mut()?.cyclic = on;
    "backgroundColor": Color, |o| Color::from_f32(o.graph()?.background),
        Appearance |o, colour| o.graph_mut()?.background = colour.to_f32();
    "foregroundColor": Color, |o| Color::from_f32(o.graph()?.foreground),
        Appearance |o, colour| o.graph_mut()?.foreground = colour.to_f32();
};

pub(in crate::property) const OCTREE: &[Accessor] = object_properties! {
    "voxelSize": f64, |o| o.octree()?.voxel_size(),
        Geometry |o, size| o.octree_mut()?.set_voxel_size(size.finite().ok_or_else(refused)?);
    "voxels": Vec<f64>, |o| o.octree()?.voxels().flat_map(|(centre, _)| centre).collect();
    "colors": Bytes, |o| Bytes(o.octree()?.voxels().flat_map(|(_, voxel)| voxel.colour).collect());
};

pub(in crate::property) const POINT_CLOUD: &[Accessor] = object_properties! {
    "points": Vec<f64>, |o| o.point_cloud()?.points.iter().flat_map(|point| point.position).collect();
    "colors": Bytes, |o| Bytes(o.point_cloud()?.points.iter().flat_map(|point| point.colour).collect());
    "ocTreeStruct": bool, |o| o.point_cloud()?.uses_octree, Geometry |o, on| o.point_cloud_mut()?.uses_octree = on;
    "pointSize": i64, |o| o.point_cloud()?.point_size,
        Appearance |o, pixels| o.point_cloud_mut()?.point_size = pixels.clamp(1, 20);
    "maxPointsInCell": i64, |o| o.point_cloud()?.max_points_in_cell,
        Geometry |o, count| o.point_cloud_mut()?.max_points_in_cell = count.clamp(1, 100_000);
    "cellSize": f64, |o| o.point_cloud()?.max_cell_size,
        Geometry |o, size| o.point_cloud_mut()?.max_cell_size = size.finite().ok_or_else(refused)?.clamp(0.001, 1.0);
    "pointDisplayFraction": f64, |o| o.point_cloud()?.display_fraction,
        Appearance |o, fraction| o.point_cloud_mut()?.display_fraction = fraction.finite().ok_or_else(refused)?.clamp(0.01, 1.0);
};
