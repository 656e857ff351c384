//! `sim.*`: creating sensors, octrees and point clouds; lights.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::appearance::colour::ColourComponent;
use scene::numbers;
use scene::sensor::volume::VolumeType;
use scene::sensor::{ProximityOptions, ProximitySensor, VisionOptions, VisionSensor};
use scene::voxels::cloud_points::CloudPoints;
use scene::voxels::octree::{OcTree, cell_size};
use scene::voxels::options::StorageOptions;
use scene::voxels::point_cloud::PointCloud;
use scene::{Field, Handle, Kind, SceneError};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_proximity_sensor,
    create_vision_sensor,
    create_octree,
    create_point_cloud,
    get_light_parameters,
    set_light_parameters,
];

/// The first `N` elements of a table that may be missing.
fn leading<T: Copy, const N: usize>(table: Option<&Vec<T>>) -> Result<Option<[T; N]>> {
    table
        .map(|values| values.first_chunk().copied().ok_or(ApiError::TableSize))
        .transpose()
}

/// A new proximity sensor at the world's origin; it looks along z.
///
/// @param sensorType sim.proximitysensor_*
/// @param subType not used
/// @param options 1: explicit handling, 8: no front faces, 16: no back faces, 32: fast
/// @param intParams faces, subdivisions and samples
/// @param floatParams offset, range, sizes, radii, angles, metres and rad
/// @return sensorHandle the sensor
#[api("sim.createProximitySensor")]
fn create_proximity_sensor(
    cx: &mut Cx,
    sensor_type: Number,
    #[default(16)] sub_type: Number,
    #[default(0)] options: Number,
    #[default(None)] int_params: Option<Vec<i64>>,
    #[default(None)] float_params: Option<Vec<f64>>,
) -> Result<Handle> {
    let _ = sub_type;
    let integers = leading(int_params.as_ref())?.unwrap_or(ProximitySensor::INTEGERS);
    let floats = leading(float_params.as_ref())?;
    let volume_type = VolumeType::from_code(sensor_type.0).ok_or(SceneError::InvalidArgument)?;
    let options = ProximityOptions::from_bits_retain(options.0);
    let sensor = ProximitySensor::new(volume_type, options, integers, floats);
    cx.add_object("proximitySensor", Kind::ProximitySensor(Box::new(sensor)))
}

/// A new vision sensor at the world's origin; it looks along z.
///
/// @param options 1: explicit handling, 2: perspective
/// @param intParams width and height in pixels, 0, 0
/// @param floatParams near and far plane in metres, angle in rad or size in metres, display size, ...
/// @return sensorHandle the sensor
#[api("sim.createVisionSensor")]
fn create_vision_sensor(
    cx: &mut Cx,
    options: Number,
    #[default(None)] int_params: Option<Vec<i64>>,
    #[default(None)] float_params: Option<Vec<f64>>,
) -> Result<Handle> {
    let options = VisionOptions::from_bits_retain(options.0);
    let [width, height, _, _] = leading(int_params.as_ref())?.unwrap_or([256, 256, 0, 0]);
    let sensor = VisionSensor::new(options, [width, height], leading(float_params.as_ref())?);
    cx.add_object("visionSensor", Kind::VisionSensor(Box::new(sensor)))
}

/// A new, empty octree at the world's origin.
///
/// @param voxelSize edge of a voxel, metres
/// @param options 2: random colours; others for display
/// @param pointSize for display, pixels
/// @return handle the octree
#[api("sim.createOctree")]
fn create_octree(cx: &mut Cx, voxel_size: f64, options: Number, point_size: f64) -> Result<Handle> {
    let mut octree = OcTree::new(voxel_size, point_size);
    octree.random_colours =
        StorageOptions::from_bits_retain(options.0).contains(StorageOptions::RANDOM_COLOURS);
    cx.add_object("octree", Kind::OcTree(Box::new(octree)))
}

/// A new, empty point cloud at the world's origin.
///
/// @param maxVoxelSize largest cell, metres
/// @param maxPtCntPerVoxel most points in a cell
/// @param options 2: random colours, 8: points are not kept in an octree; others for display
/// @param pointSize for display, pixels
/// @return handle the point cloud
#[api("sim.createPointCloud")]
fn create_point_cloud(
    cx: &mut Cx,
    max_voxel_size: f64,
    max_pt_cnt_per_voxel: Number,
    options: Number,
    point_size: f64,
) -> Result<Handle> {
    let options = StorageOptions::from_bits_retain(options.0);
    let max_points_in_cell = max_pt_cnt_per_voxel.0.max(1);
    let cloud = PointCloud {
        max_cell_size: cell_size(max_voxel_size),
        max_points_in_cell,
        point_size: numbers::truncated(point_size),
        uses_octree: !options.contains(StorageOptions::WITHOUT_OCTREE),
        display_fraction: 1.0,
        random_colours: options.contains(StorageOptions::RANDOM_COLOURS),
        points: CloudPoints::default(),
    };
    cx.add_object("pointCloud", Kind::PointCloud(Box::new(cloud)))
}

/// State, three zeros, diffuse and specular colour.
type LightParameters = (i64, [f64; 3], [f64; 3], [f64; 3]);

/// State and colours of a light.
///
/// @param lightHandle the light
/// @return state 1 when it is on
/// @return zero three zeros
/// @return diffusePart red, green, blue
/// @return specular red, green, blue
#[api("sim.getLightParameters")]
fn get_light_parameters(cx: &Cx, light_handle: Handle) -> Result<LightParameters> {
    let scene = cx.scene();
    let light = scene.object(light_handle)?.light()?;
    Ok((
        i64::from(light.enabled),
        [0.0; 3],
        light.colour.ambient_diffuse.map(f64::from),
        light.colour.specular.map(f64::from),
    ))
}

/// Changes state and colours of a light.
///
/// @param lightHandle the light
/// @param state 1 for on
/// @param reserved not used
/// @param diffusePart red, green, blue
/// @param specularPart red, green, blue
#[api("sim.setLightParameters")]
fn set_light_parameters(
    cx: &mut Cx,
    light_handle: Handle,
    state: Number,
    #[default(None)] reserved: Option<[f64; 3]>,
    #[default(None)] diffuse_part: Option<[f64; 3]>,
    #[default(None)] specular_part: Option<[f64; 3]>,
) -> Result<()> {
    let _ = reserved;
    Ok(cx
        .scene_mut()
        .try_modify(light_handle, Field::Appearance, |object| {
            let light = object.light_mut()?;
            light.enabled = state.0 != 0;
            let parts = [
                (ColourComponent::AmbientDiffuse, diffuse_part),
                (ColourComponent::Specular, specular_part),
            ];
            for (component, part) in parts {
                if let Some(part) = part {
                    light.colour.set_component(component, &part);
                }
            }
            Ok(())
        })?)
}
