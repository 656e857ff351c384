//! Where an imported robot stands.

use nalgebra::{Point3, Vector3};

use scene::{Handle, Scene, SceneResult};

/// Moves objects so that their shapes are centred on the z axis of the world and stand on its ground.
pub(super) fn lift_to_ground(
    scene: &mut Scene,
    objects: &[Handle],
    roots: &[Handle],
) -> SceneResult<()> {
    let Some((low, high)) = extent(scene, objects)? else {
        return Ok(());
    };
    let offset = Vector3::new(-(low.x + high.x) / 2.0, -(low.y + high.y) / 2.0, -low.z);
    for root in roots {
        let mut pose = scene.world_pose(*root)?;
        pose.translation.vector += offset;
        scene.set_world_pose(*root, pose)?;
    }
    Ok(())
}

/// The smallest and largest coordinates of what shapes consist of.
fn extent(scene: &Scene, objects: &[Handle]) -> SceneResult<Option<(Point3<f64>, Point3<f64>)>> {
    let mut extent: Option<(Point3<f64>, Point3<f64>)> = None;
    for handle in objects {
        let Ok(shape) = scene.object(*handle)?.shape() else {
            continue;
        };
        let pose = scene.world_pose(*handle)?;
        for part in &shape.parts {
            let placed = pose * part.pose;
            for vertex in &part.mesh.vertices {
                let point = placed * Point3::from(*vertex);
                extent = Some(match extent {
                    Some((low, high)) => (low.inf(&point), high.sup(&point)),
                    None => (point, point),
                });
            }
        }
    }
    Ok(extent)
}
