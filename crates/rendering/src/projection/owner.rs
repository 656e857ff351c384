//! Drawable content, in drawing order.

use std::ops::Range;

use geometry::{Finite, Pose};

use crate::projection::strokes::{Placed, add_edges, add_lines, add_points};
use crate::projection::surface::{Setup, Surface};
use crate::projection::view::View;
use crate::{Channels, Edges, Instance, Lines, Material, Mesh, Points, World};

/// Elements of a list that are projected together.
const BATCH_SIZE: usize = 512;

/// Owner of faces.
#[derive(Debug)]
pub struct Owner<'a> {
    pub id: u32,
    pub content: Content<'a>,
    pub pass: Pass,
    /// How much of what is behind it is covered.
    pub opacity: f32,
    /// Whether only colours show it, but neither depths nor ids.
    pub is_decoration: bool,
}

/// Content of an owner.
#[derive(Debug)]
pub enum Content<'a> {
    Surface(Surface<'a>, &'a Material),
    Edges(Placed<'a, Mesh>, Edges),
    Points(Placed<'a, Points<'a>>),
    Lines(Placed<'a, Lines<'a>>),
}

/// When an owner is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pass {
    /// The closest face hides the others.
    Opaque,
    /// Over what is opaque, from back to front.
    Blended,
    /// Over everything.
    Overlay,
}

/// All owners of a world. A face refers to its owner by its place in the list.
pub fn owners<'a>(world: &World<'a>, view: &View, channels: Channels) -> Vec<Owner<'a>> {
    let mut owners = Vec::with_capacity(world.instances.len());
    for instance in world
        .instances
        .iter()
        .filter(|instance| instance.pose.is_finite())
    {
        owners.push(surface(
            instance,
            view,
            channels,
            numbers::count_u32(owners.len()),
        ));
        owners.extend(edges(
            instance,
            view,
            channels,
            numbers::count_u32(owners.len()),
        ));
    }
    for points in world.points.iter().filter(|points| points.pose.is_finite()) {
        let placed = placed(points, &points.pose, view, owners.len());
        owners.push(strokes(points.id, Content::Points(placed), points.overlay));
    }
    for lines in world.lines.iter().filter(|lines| lines.pose.is_finite()) {
        let placed = placed(lines, &lines.pose, view, owners.len());
        owners.push(strokes(lines.id, Content::Lines(placed), lines.overlay));
    }
    owners
}

fn placed<'a, T>(content: &'a T, pose: &Pose, view: &View, at: usize) -> Placed<'a, T> {
    Placed {
        content,
        transform: view.transform(pose),
        owner: numbers::count_u32(at),
    }
}

fn surface<'a>(instance: &Instance<'a>, view: &View, channels: Channels, at: u32) -> Owner<'a> {
    let (mesh, material, transform) = (
        instance.mesh,
        instance.material,
        view.transform(&instance.pose),
    );
    // Depths and ids do not depend on transparency.
    let is_blended = material.opacity < 1.0 && channels.colour;
    let in_front = transform.apply(&mesh.ball.centre).z - mesh.ball.radius > view.near;
    let culling = material.culling || (mesh.closed && in_front && !is_blended);
    let surface = Surface {
        mesh,
        transform,
        culling,
        wire_frame: material.wireframe,
        owner: at,
    };
    Owner {
        id: instance.id,
        content: Content::Surface(surface, material),
        pass: if is_blended {
            Pass::Blended
        } else {
            Pass::Opaque
        },
        opacity: material.opacity.clamp(0.0, 1.0),
        is_decoration: false,
    }
}

fn edges<'a>(
    instance: &Instance<'a>,
    view: &View,
    channels: Channels,
    at: u32,
) -> Option<Owner<'a>> {
    let edges = instance.material.edges.filter(|_| channels.colour)?;
    let content = Content::Edges(
        placed(instance.mesh, &instance.pose, view, numbers::place(at)),
        edges,
    );
    Some(Owner {
        id: instance.id,
        content,
        pass: Pass::Blended,
        opacity: 1.0,
        is_decoration: true,
    })
}

fn strokes(id: u32, content: Content, is_overlay: bool) -> Owner {
    let pass = if is_overlay {
        Pass::Overlay
    } else {
        Pass::Opaque
    };
    Owner {
        id,
        content,
        pass,
        opacity: 1.0,
        is_decoration: false,
    }
}

impl<'a> Content<'a> {
    /// Of a surface.
    pub fn material(&self) -> Option<&'a Material> {
        match self {
            Self::Surface(_, material) => Some(material),
            _ => None,
        }
    }

    /// Whether it may be in the picture.
    pub fn may_be_seen(&self, view: &View) -> bool {
        match self {
            Self::Surface(
                Surface {
                    mesh, transform, ..
                },
                _,
            )
            | Self::Edges(
                Placed {
                    content: mesh,
                    transform,
                    ..
                },
                _,
            ) => view.may_see(transform.apply(&mesh.ball.centre), mesh.ball.radius),
            Self::Points(_) | Self::Lines(_) => true,
        }
    }

    /// The numbers of elements in the pieces that are projected together.
    pub fn pieces(&self) -> impl Iterator<Item = usize> {
        let (clusters, elements) = match self {
            Self::Surface(surface, _) => (surface.mesh.clusters.as_slice(), 0),
            Self::Edges(mesh, _) => (&[][..], mesh.content.edges().len()),
            Self::Points(points) => (&[][..], points.content.positions.len()),
            Self::Lines(lines) => (&[][..], lines.content.segments.len()),
        };
        let sizes = clusters.iter().map(|cluster| cluster.triangles.len());
        sizes.chain(
            (0..elements)
                .step_by(BATCH_SIZE)
                .map(move |first| BATCH_SIZE.min(elements - first)),
        )
    }

    /// Adds the faces of a piece.
    pub fn project(&self, view: &View, piece: usize, setup: &mut Setup) {
        let range = |elements: usize| -> Range<usize> {
            piece * BATCH_SIZE..elements.min((piece + 1) * BATCH_SIZE)
        };
        let faces = &mut setup.faces;
        match self {
            Self::Surface(surface, _) => {
                setup.add_cluster(view, surface, &surface.mesh.clusters[piece]);
            }
            Self::Edges(mesh, edges) => {
                add_edges(faces, view, mesh, edges, range(mesh.content.edges().len()));
            }
            Self::Points(points) => {
                add_points(faces, view, points, range(points.content.positions.len()));
            }
            Self::Lines(lines) => {
                add_lines(faces, view, lines, range(lines.content.segments.len()));
            }
        }
    }
}
