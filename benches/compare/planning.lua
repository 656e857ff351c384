-- Builds the task of the table TASK (see planning.py), plans it, and prints what each planner has found and how long that took.
sim = require 'sim'
simOMPL = require 'simOMPL'

local function row(...) print(table.concat({...}, ' ')) end

local function mesh(it) return sim.createShape(0, 0, it.vertices, it.triangles) end

local function arm()
    local joints, parent = {}, -1
    for i, matrix in ipairs(TASK.joints) do
        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setJointInterval(joint, false, {-math.pi, 2 * math.pi})
        if parent ~= -1 then sim.setObjectParent(joint, parent, true) end
        sim.setObjectMatrix(joint, matrix, parent)
        joints[i], parent = joint, joint
    end
    return joints
end

local function setSpace(task, robot)
    if not TASK.joints then
        local space = simOMPL.createStateSpace('body', simOMPL.StateSpaceType.pose3d, robot, TASK.low, TASK.high, 1)
        simOMPL.setStateSpace(task, {space})
    else
        simOMPL.setStateSpaceForJoints(task, robot, {1})
    end
end

local function seconds(f, ...)
    local begin = os.clock()
    local result = f(...)
    return os.clock() - begin, result
end

local function plan(task, number, planner, query)
    simOMPL.setAlgorithm(task, simOMPL.Algorithm[planner])
    simOMPL.setStartState(task, query[1])
    simOMPL.setGoalState(task, query[2])
    simOMPL.setup(task)
    local took = seconds(simOMPL.solve, task, TASK.time)
    if not simOMPL.hasExactSolution(task) then return row('FAILED', planner, number, took) end
    local first = simOMPL.getPath(task)
    local more = seconds(simOMPL.simplifyPath, task)
    local short = simOMPL.getPath(task)
    simOMPL.interpolatePath(task, 0)
    row('FOUND', planner, number, took, more)
    for _, path in ipairs{first, short, simOMPL.getPath(task)} do row('PATH', table.unpack(path)) end
end

function sysCall_init()
    local robot, shapes = TASK.joints and arm(), {}
    for i, it in ipairs(TASK.robot) do
        shapes[i] = mesh(it)
        if TASK.joints then sim.setObjectParent(shapes[i], robot[i], true) end
    end
    robot = robot or shapes[1]
    local moving, still = sim.createCollection(0), sim.createCollection(0)
    for _, shape in ipairs(shapes) do sim.addItemToCollection(moving, sim.handle_single, shape, 0) end
    for _, it in ipairs(TASK.obstacles) do sim.addItemToCollection(still, sim.handle_single, mesh(it), 0) end
    local task = simOMPL.createTask('compared')
    setSpace(task, robot)
    simOMPL.setCollisionPairs(task, {moving, still})
    simOMPL.setStartState(task, TASK.queries[1][1])
    simOMPL.setGoalState(task, TASK.queries[1][2])
    simOMPL.setup(task)
    for i, state in ipairs(TASK.states) do row('VALID', i, tostring(simOMPL.isStateValid(task, state))) end
    for _, planner in ipairs(TASK.planners) do
        for number, query in ipairs(TASK.queries) do plan(task, number, planner, query) end
    end
end
