//! Rays of a lidar, measured in the depths that vision sensors see: one sensor for each sector of the turn.

use api_macro::api;

use super::{check_length, count, floats};
use crate::sim_ros2::{ApiError, ApiFn, Cx, Result, functions};
use scene::Data;
use script::{Bytes, Table};

pub(super) const FUNCTIONS: &[ApiFn] = functions![ranges, cloud_of_ranges];

/// Depths next to each other that differ more are of different things: between them is no surface.
const STEP: f64 = 0.2;
/// How much of the far plane's distance is taken for nothing there.
const NOTHING: f64 = 1.0 - 1e-5;

/// The rays in a plane or a cone: their number and their first and last angle.
struct Fan {
    count: usize,
    first: f64,
    step: f64,
}

impl Fan {
    fn new(count: usize, first: f64, last: f64) -> Self {
        let step = if count > 1 {
            (last - first) / (count - 1) as f64
        } else {
            0.0
        };
        Self { count, first, step }
    }

    fn angle(&self, index: usize) -> f64 {
        self.first + self.step * index as f64
    }
}

/// What a sensor sees ahead of it.
struct Picture<'a> {
    depths: Vec<f64>,
    width: usize,
    height: usize,
    /// The tangents of half of what it sees, to the side and up.
    tangents: [f64; 2],
    lidar: &'a Lidar,
}

/// Numbers of a lidar, by their names for scripts.
struct Lidar {
    fans: [Fan; 2],
    ranges: [f64; 2],
    sectors: usize,
    width: usize,
    height: usize,
    tangent: f64,
}

impl Lidar {
    fn new(table: &Data) -> Result<Self> {
        let number = |name: &str| match table.field(name) {
            Some(Data::Float(number)) => Ok(*number),
            Some(Data::Int(number)) => Ok(*number as f64),
            _ => Err(ApiError::Other(format!("a lidar has no {name}"))),
        };
        let whole = |name: &str| count(scene::numbers::truncated(number(name)?));
        Ok(Self {
            fans: [
                Fan::new(
                    whole("samples")?,
                    number("min_angle")?,
                    number("max_angle")?,
                ),
                Fan::new(
                    whole("vertical_samples")?,
                    number("min_vertical_angle")?,
                    number("max_vertical_angle")?,
                ),
            ],
            ranges: [number("min_range")?, number("max_range")?],
            sectors: whole("sectors")?,
            width: whole("width")?,
            height: whole("height")?,
            tangent: number("tangent")?,
        })
    }

    /// The sector that a ray is in, and its angle from the middle of that.
    fn sector(&self, angle: f64) -> (usize, f64) {
        let [fan, _] = &self.fans;
        let last = fan.angle(fan.count - 1);
        let width = (last - fan.first) / self.sectors as f64;
        let index = if width > 0.0 {
            ((angle - fan.first) / width) as usize
        } else {
            0
        };
        let index = index.min(self.sectors - 1);
        (index, angle - fan.first - width * (index as f64 + 0.5))
    }
}

impl Picture<'_> {
    /// The distance to what a ray meets, whose angles are those from the middle of the sector and from the plane.
    fn range(&self, across: f64, up: f64) -> f64 {
        let ahead = libm::cos(across) * libm::cos(up);
        let left = libm::tan(across) / self.tangents[0];
        let high = libm::tan(up) / libm::cos(across) / self.tangents[1];
        let column = ((1.0 - left) * self.width as f64 - 1.0) / 2.0;
        let row = ((1.0 + high) * self.height as f64 - 1.0) / 2.0;
        self.kept(self.depth(column, row) / ahead)
    }

    fn kept(&self, range: f64) -> f64 {
        let [low, high] = self.lidar.ranges;
        if range < low {
            f64::NEG_INFINITY
        } else if range <= high * NOTHING {
            range
        } else {
            f64::INFINITY
        }
    }

    fn pixel(&self, column: f64, row: f64) -> f64 {
        let column = column.clamp(0.0, self.width as f64 - 1.0) as usize;
        let row = row.clamp(0.0, self.height as f64 - 1.0) as usize;
        self.depths[row * self.width + column]
    }

    /// The depth between pixels. The inverse of the depth of a plane is linear in a picture.
    fn depth(&self, column: f64, row: f64) -> f64 {
        let (low, left) = (libm::floor(row), libm::floor(column));
        let (up, right) = (row - low, column - left);
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let depths = corners.map(|(x, y)| self.pixel(left + x, low + y));
        let nearest = depths.iter().copied().fold(f64::INFINITY, f64::min);
        let farthest = depths.iter().copied().fold(0.0, f64::max);
        if farthest > nearest * (1.0 + STEP) {
            return self.pixel(libm::round(column), libm::round(row));
        }
        let weights = [
            (1.0 - right) * (1.0 - up),
            right * (1.0 - up),
            (1.0 - right) * up,
            right * up,
        ];
        let inverse: f64 = depths
            .iter()
            .zip(weights)
            .map(|(depth, weight)| weight / depth)
            .sum();
        1.0 / inverse
    }
}

/// What the rays of a lidar measure, from the lowest cone on, and in each from the first angle on: infinite where nothing is, below zero without end where it is too near.
///
/// @param pictures 32-bit floats of each sector, metres, the lowest row first
/// @param lidar its numbers
/// @return ranges metres
#[api("remote.ros2.robots.ranges")]
fn ranges(_cx: &Cx, pictures: Table, lidar: Table) -> Result<Vec<f64>> {
    let lidar = Lidar::new(&lidar.0)?;
    let pictures = sectors(&pictures.0, &lidar)?;
    let [fan, cones] = &lidar.fans;
    let mut ranges = Vec::with_capacity(fan.count * cones.count);
    for cone in 0..cones.count {
        for ray in 0..fan.count {
            let (sector, across) = lidar.sector(fan.angle(ray));
            ranges.push(pictures[sector].range(across, cones.angle(cone)));
        }
    }
    Ok(ranges)
}

fn sectors<'a>(pictures: &Data, lidar: &'a Lidar) -> Result<Vec<Picture<'a>>> {
    let Data::Array(pictures) = pictures else {
        return Err(ApiError::Other("a lidar has no pictures".into()));
    };
    let side = lidar.height as f64 / lidar.width as f64;
    let mut sectors = Vec::new();
    for picture in pictures.iter().take(lidar.sectors) {
        let (Data::Text(bytes) | Data::Buffer(bytes)) = picture else {
            return Err(ApiError::Other("a picture of a lidar is none".into()));
        };
        check_length("picture", bytes, lidar.width.checked_mul(lidar.height * 4))?;
        sectors.push(Picture {
            depths: floats(bytes)
                .map(|depth| f64::from(depth).max(1e-9))
                .collect(),
            width: lidar.width,
            height: lidar.height,
            tangents: [lidar.tangent, lidar.tangent * side],
            lidar,
        });
    }
    if sectors.len() == lidar.sectors {
        Ok(sectors)
    } else {
        Err(ApiError::Other("a picture of a lidar is missing".into()))
    }
}

/// The points that the rays of a lidar have met: x ahead, y to the left, z up.
///
/// @param ranges as measured
/// @param lidar its numbers
/// @return points x, y, z of each as 32-bit floats
#[api("remote.ros2.robots.cloudOfRanges")]
fn cloud_of_ranges(_cx: &Cx, ranges: Vec<f64>, lidar: Table) -> Result<Bytes> {
    let lidar = Lidar::new(&lidar.0)?;
    let [fan, cones] = &lidar.fans;
    let mut points = Vec::new();
    for (index, range) in ranges
        .iter()
        .enumerate()
        .filter(|(_, range)| range.is_finite())
    {
        let (across, up) = (fan.angle(index % fan.count), cones.angle(index / fan.count));
        let flat = range * libm::cos(up);
        for coordinate in [
            flat * libm::cos(across),
            flat * libm::sin(across),
            range * libm::sin(up),
        ] {
            points.extend((coordinate as f32).to_le_bytes());
        }
    }
    Ok(Bytes(points))
}
