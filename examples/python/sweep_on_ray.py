#!/usr/bin/env python3
"""A sweep over a cluster of Ray: the gain and the seed of a scene, one task for each run.

    pip install '.[ray]'
    python3 examples/python/sweep_on_ray.py scene.lua kp=1,2,5 --seeds 100 [--cluster ray://head:10001]
"""

import argparse

from swanilda.ray import dataset, sweep


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("params", nargs="*", metavar="NAME=V1,V2,...")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--cluster")
    parser.add_argument("--out", default="results")
    args = parser.parse_args()
    params = {name: values.split(",") for name, _, values in (param.partition("=") for param in args.params)}
    table = sweep(args.scene, params, range(args.seeds), args.cluster, out=args.out)
    print(table)
    print(dataset(args.out).schema())


if __name__ == "__main__":
    main()
