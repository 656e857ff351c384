// Validates all glTF files of a folder: errors and warnings are faults, and what they contain must be what was put into them.
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

const expected = {
    'scene.glb': {animationCount: 1, hasTextures: true, totalTriangleCount: 141, materialCount: 3},
    'scene.gltf': {animationCount: 1, hasTextures: true, totalTriangleCount: 141, materialCount: 3},
    'shapes.glb': {animationCount: 0, hasTextures: true, totalTriangleCount: 129, materialCount: 2},
    'empty.glb': {animationCount: 0, hasTextures: false, totalTriangleCount: 0},
};

async function check(folder) {
    const names = fs.readdirSync(folder).sort();
    for (const name of names) {
        const bytes = new Uint8Array(fs.readFileSync(path.join(folder, name)));
        const {issues, info} = await validator.validateBytes(bytes, {uri: name});
        if (issues.numErrors + issues.numWarnings > 0) console.log(name, JSON.stringify(issues.messages, null, 1));
        for (const [key, value] of Object.entries(expected[name])) {
            if (info[key] !== value) console.log(name, key, info[key], 'instead of', value);
        }
    }
    console.log(names.length, 'files');
}

check(process.argv[2]);
