//! Objects that exist as data until their behaviour is built: sensors, cameras, lights, graphs, voxels.

use super::Handle;

/// What a proximity sensor sees with.
#[derive(Debug, Clone, PartialEq)]
pub struct ProximitySensor {
    /// `sim.proximitysensor_*` sub-type number.
    pub volume_type: i64,
    pub explicit: bool,
    pub size: f64,
    pub integers: Vec<i64>,
    pub floats: Vec<f64>,
    pub front_faces: bool,
    pub back_faces: bool,
    pub exact: bool,
    pub entity: i64,
}

#[derive(Debug, Clone, PartialEq)]
pub struct VisionSensor {
    pub explicit: bool,
    pub perspective: bool,
    /// Width, height in pixels.
    pub resolution: [u32; 2],
    /// Near, far in metres.
    pub clipping: [f64; 2],
    /// Radians.
    pub view_angle: f64,
    pub ortho_size: f64,
    pub size: f64,
    pub entity: i64,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    pub perspective: bool,
    pub clipping: [f64; 2],
    pub view_angle: f64,
    pub ortho_size: f64,
    pub size: f64,
    pub tracked: Option<Handle>,
}

impl Default for Camera {
    fn default() -> Self {
        let (clipping, view_angle) = ([0.1, 1000.0], 60f64.to_radians());
        Self { perspective: true, clipping, view_angle, ortho_size: 2.0, size: 0.05, tracked: None }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// 1 omnidirectional, 2 spot, 3 directional.
    pub light_type: i64,
    pub enabled: bool,
    pub diffuse: [f32; 3],
    pub specular: [f32; 3],
    pub size: f64,
}

impl Light {
    pub fn new(light_type: i64) -> Self {
        Self { light_type, enabled: true, diffuse: [0.5; 3], specular: [0.25; 3], size: 0.1 }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    pub explicit: bool,
    pub buffer_size: usize,
    pub size: f64,
}

impl Default for Graph {
    fn default() -> Self {
        Self { explicit: false, buffer_size: 1000, size: 0.05 }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct OcTree {
    pub voxel_size: f64,
    pub point_size: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub struct PointCloud {
    pub max_cell_size: f64,
    pub max_points_in_cell: i64,
    pub point_size: f64,
}
