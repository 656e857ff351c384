--[[
Convex hulls and convex decomposition of shapes.

    hull(objects, growth = 0)       a new shape around shapes, dummies, point clouds and octrees; its frame is the world's
    qhull(points, growth = 0)       vertices and indices of the hull of points, three coordinates each
    vhacd(shape, params = {})       convex decomposition: a list of new shapes; the original stays
    hacd(shape, params = {})        the same algorithm

growth moves the faces outwards, in metres. params: resolution (100000, voxels in all, at most 16 million), concavity (0.1),
plane_downsampling (4), hull_downsampling (4), alpha (0.05), beta (0.05). Other fields, and all those of hacd, have no effect.
]]

local _, native = ...

return native
