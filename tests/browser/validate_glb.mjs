// Khronos' validator over GLB files: node validate_glb.mjs FILE.glb …
// Needs `npm install gltf-validator` where node finds it. Ends with 1 on any error or warning.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(process.cwd() + "/");
const validator = require("gltf-validator");
let bad = process.argv.length < 3;
for (const path of process.argv.slice(2)) {
  const bytes = new Uint8Array(readFileSync(path));
  const { issues, info } = await validator.validateBytes(bytes, { maxIssues: 20 });
  const { numErrors, numWarnings, numInfos, numHints } = issues;
  const { drawCallCount, totalVertexCount, totalTriangleCount } = info;
  console.log(path, { numErrors, numWarnings, numInfos, numHints });
  console.log({ meshes: drawCallCount, vertices: totalVertexCount, triangles: totalTriangleCount });
  for (const { code, message, pointer } of issues.messages) console.log(code, message, pointer);
  bad ||= numErrors + numWarnings > 0;
}
process.exit(bad ? 1 : 0);
