#!/bin/sh
# simROS2 with nodes of an installed ROS 2 (made for Jazzy), for somebody who has one: it is not part of the tests.
#
#     source /opt/ros/jazzy/setup.sh
#     sh tests/interop/ros2_stock.sh target/release/swanilda
#
# Try it with both middlewares: RMW_IMPLEMENTATION=rmw_fastrtps_cpp and rmw_cyclonedds_cpp.
set -eu
program=${1:?the path of swanilda}
folder=$(dirname "$0")
export ROS_DOMAIN_ID=${ROS_DOMAIN_ID:-77} ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST ROS_LOCALHOST_ONLY=1
output=$(mktemp)

"$program" run --empty --realtime --ros2-bridge "$folder/ros2_stock_scene.lua" > "$output" 2>&1 &
simulator=$!
trap 'kill $simulator 2> /dev/null; cat "$output"; rm -f "$output"' EXIT
sleep 2

expect() {
    what=$1
    pattern=$2
    shift 2
    said=$(timeout 20 "$@" 2>&1) || true
    if printf '%s' "$said" | grep -q "$pattern"; then
        echo "ok: $what"
    else
        printf 'FAILED: %s\n%s\n' "$what" "$said"
        exit 1
    fi
}

expect "topics are listed" '^/latched$' ros2 topic list --no-daemon
expect "a durable topic" 'data: three' ros2 topic echo --no-daemon --once --qos-durability transient_local --qos-reliability reliable /latched std_msgs/msg/String
expect "a topic of sensors" 'frame_id: laser' ros2 topic echo --no-daemon --once --qos-reliability best_effort /scan sensor_msgs/msg/LaserScan
expect "the clock" 'sec:' ros2 topic echo --no-daemon --once /clock rosgraph_msgs/msg/Clock
expect "transforms" 'child_frame_id' ros2 topic echo --no-daemon --once /tf tf2_msgs/msg/TFMessage
expect "a service" "answered true" ros2 service call /set std_srvs/srv/SetBool '{data: true}'
expect "an action" 'SUCCEEDED' ros2 action send_goal --feedback /fibonacci example_interfaces/action/Fibonacci '{order: 5}'
ros2 topic pub --times 5 /best_effort geometry_msgs/msg/Twist '{linear: {x: 1.5}}' > /dev/null
grep -q 'twist 1.5' "$output" && echo "ok: a subscription"
