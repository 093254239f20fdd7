// Bodies, lines and waves in space, by three.js. Axes are those of the scene: z up.
import {
  AmbientLight,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  MeshPhongMaterial,
  PerspectiveCamera,
  PlaneGeometry,
  Points,
  PointsMaterial,
  Quaternion,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
  EdgesGeometry,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { colour, styled } from './colours.js';
import { numbers } from './data.js';
import { cornersOf, extentAtRest, lineAt, poseAt } from './poses.js';
import { surfaceOf } from './water.js';

const CELLS = 96; // of the water along each side

/** Throws where there is no WebGL. @param {HTMLElement} place @param {object} view */
export function view3d(place, view) {
  const renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
  const scene = new Scene(),
    camera = new PerspectiveCamera(38, 2, 0.1, 10000);
  camera.up.set(0, 0, 1);
  const [low, high] = extentAtRest(view);
  const middle = new Vector3(...low.map((v, i) => (v + high[i]) / 2));
  const size = Math.max(high[0] - low[0], high[1] - low[1], (high[2] - low[2]) * 1.5, 4);
  const sun = new DirectionalLight(0xffffff, 2.4);
  sun.position.set(-size, -1.4 * size, 2 * size);
  scene.add(new AmbientLight(0xffffff, 1.5), sun);

  const bodies = view.bodies.map((body, i) => bodyObject(body, i));
  const lines = view.lines.map((line) => lineObject(line));
  const water = waterObject(view, middle, size);
  scene.add(...bodies.map((b) => b.object), ...lines.map((l) => l.object), water.object);
  const bed = view.depth && view.depth < 1.2 * size ? bedObject(view.depth, middle, size) : null;
  if (bed) scene.add(bed);

  place.append(renderer.domElement);
  renderer.domElement.tabIndex = 0;
  renderer.domElement.setAttribute('role', 'img');
  renderer.domElement.setAttribute(
    'aria-label',
    'Bodies, lines and waves in space. Arrow keys turn the view, plus and minus come nearer.',
  );
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.enablePan = true;
  controls.maxPolarAngle = 0.62 * Math.PI;
  const target = new Vector3(middle.x, middle.y, Math.max(middle.z, -0.12 * size));

  function reset() {
    controls.target.copy(target);
    camera.position.set(target.x - 0.5 * size, target.y - 1.05 * size, target.z + 0.55 * size);
    camera.far = 20 * size;
    controls.update();
  }
  function resize() {
    const width = place.clientWidth || 600,
      height = Math.round(Math.min(Math.max(width * 0.5, 260), 560));
    renderer.setPixelRatio(Math.min(devicePixelRatio || 1, 2));
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    render();
  }
  const render = () => renderer.render(scene, camera);
  controls.addEventListener('change', render);

  /** About the target by angles, rad, and to a share of the distance. */
  function orbit(azimuth, elevation, nearer = 1) {
    const offset = camera.position.clone().sub(controls.target);
    const r = offset.length() * nearer,
      polar = Math.acos(offset.z / offset.length()),
      angle = Math.atan2(offset.y, offset.x) + azimuth;
    const p = Math.min(Math.max(polar + elevation, 0.05), controls.maxPolarAngle);
    camera.position
      .set(Math.sin(p) * Math.cos(angle), Math.sin(p) * Math.sin(angle), Math.cos(p))
      .multiplyScalar(r)
      .add(controls.target);
    controls.update();
    render();
  }
  renderer.domElement.addEventListener('keydown', (event) => {
    const move = {
      ArrowLeft: [-0.1, 0],
      ArrowRight: [0.1, 0],
      ArrowUp: [0, -0.1],
      ArrowDown: [0, 0.1],
      '+': [0, 0, 0.88],
      '=': [0, 0, 0.88],
      '-': [0, 0, 1.14],
    }[event.key];
    if (!move) return;
    orbit(...move);
    event.preventDefault();
  });
  reset();
  new ResizeObserver(resize).observe(place);
  return {
    canvas: renderer.domElement,
    reset: () => {
      reset();
      render();
    },
    show(t, frame, share) {
      bodies.forEach((b) => b.move(frame, share));
      lines.forEach((l) => l.move(frame, share));
      water.move(t);
      render();
    },
    repaint: () => {
      bed?.material.color.set(styled('--bed'));
      bodies.forEach((b) => b.paint());
      lines.forEach((l) => l.paint());
      render();
    },
  };
}

function geometryOf(shape) {
  const between = (a, b) => a.map((v, i) => (v + b[i]) / 2);
  if (shape.kind === 'box')
    return new BoxGeometry(...shape.high.map((v, i) => v - shape.low[i])).translate(...between(shape.low, shape.high));
  if (shape.kind === 'sphere') return new SphereGeometry(shape.radius, 32, 20).translate(...shape.centre);
  if (shape.kind === 'cylinder') {
    const axis = new Vector3(...shape.to).sub(new Vector3(...shape.from));
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), axis.clone().normalize());
    return new CylinderGeometry(shape.radius, shape.radius, axis.length(), 28)
      .applyQuaternion(turn)
      .translate(...between(shape.from, shape.to));
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(numbers(shape.vertices)), 3));
  geometry.setIndex(shape.triangles);
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}

function bodyObject(body, i) {
  const object = new Group(),
    pale = !body.moves;
  const skin = new MeshLambertMaterial({ transparent: pale, opacity: pale ? 0.35 : 1, side: DoubleSide });
  const edge = new LineBasicMaterial({ transparent: true, opacity: pale ? 0.25 : 0.55 });
  for (const shape of body.shapes) {
    const geometry = geometryOf(shape);
    object.add(new Mesh(geometry, skin), new LineSegments(new EdgesGeometry(geometry, 30), edge));
  }
  if (body.shapes.length > 1) object.add(frameObject(body, edge));
  const paint = () => {
    skin.color = new Color(colour(i));
    edge.color = new Color(styled('--ink'));
  };
  paint();
  return {
    object,
    paint,
    move(frame, share) {
      const { origin, q } = poseAt(body, frame, share);
      object.position.set(...origin);
      object.quaternion.set(...q);
    },
  };
}

/** The edges of the box about the parts of a body, so that they are seen to belong together. */
function frameObject(body, material) {
  const low = [Infinity, Infinity, Infinity],
    high = [-Infinity, -Infinity, -Infinity];
  for (const shape of body.shapes)
    for (const p of cornersOf(shape))
      p.forEach((v, k) => {
        low[k] = Math.min(low[k], v);
        high[k] = Math.max(high[k], v);
      });
  const box = new BoxGeometry(...high.map((v, k) => v - low[k])).translate(...low.map((v, k) => (v + high[k]) / 2));
  return new LineSegments(new EdgesGeometry(box), material);
}

function lineObject(line) {
  const geometry = new BufferGeometry(),
    places = new Float32Array(3 * line.points);
  const pieces = new Float32Array(6 * Math.max(line.points - 1, 1));
  geometry.setAttribute('position', new BufferAttribute(pieces, 3));
  const material = new LineBasicMaterial({ linewidth: 2 }),
    nodes = new PointsMaterial({ size: 4, sizeAttenuation: false });
  const object = new Group(),
    drawn = new LineSegments(geometry, material);
  const known = new BufferGeometry();
  known.setAttribute('position', new BufferAttribute(new Float32Array(3 * line.points), 3));
  const dots = new Points(known, nodes);
  drawn.frustumCulled = dots.frustumCulled = false;
  object.add(drawn);
  if (line.kind === 'line') object.add(dots);
  const paint = () => {
    material.color = nodes.color = new Color(line.kind === 'connector' ? colour(1) : styled('--rope'));
  };
  paint();
  return {
    object,
    paint,
    move(frame, share) {
      lineAt(line, frame, share, places);
      let used = 0,
        seen = 0;
      const dot = known.attributes.position.array;
      for (let p = 0; p < line.points; ++p) {
        const here = places.subarray(3 * p, 3 * p + 3),
          next = places.subarray(3 * p + 3, 3 * p + 6);
        if (!Number.isFinite(here[0])) continue;
        dot.set(here, 3 * seen++);
        if (p + 1 < line.points && Number.isFinite(next[0])) {
          pieces.set(here, used);
          pieces.set(next, used + 3);
          used += 6;
        }
      }
      geometry.setDrawRange(0, used / 3);
      known.setDrawRange(0, seen);
      geometry.attributes.position.needsUpdate = known.attributes.position.needsUpdate = true;
    },
  };
}

function waterObject(view, middle, size) {
  const side = 2.2 * size,
    surface = surfaceOf(view.surface);
  const geometry = new PlaneGeometry(side, side, CELLS, CELLS).translate(middle.x, middle.y, 0);
  const object = new Mesh(
    geometry,
    new MeshPhongMaterial({
      color: 0x2f9fd8,
      shininess: 60,
      transparent: true,
      opacity: 0.6,
      side: DoubleSide,
      depthWrite: false,
    }),
  );
  const p = geometry.attributes.position,
    reach = 0.75 * side + Math.hypot(middle.x, middle.y);
  return {
    object,
    move(t) {
      surface.prepare(t, reach);
      for (let i = 0; i < p.count; ++i) p.setZ(i, surface.at(p.getX(i), p.getY(i)));
      p.needsUpdate = true;
      geometry.computeVertexNormals();
    },
  };
}

function bedObject(depth, middle, size) {
  const geometry = new PlaneGeometry(2.2 * size, 2.2 * size, 1, 1).translate(middle.x, middle.y, -depth);
  return new Mesh(geometry, new MeshLambertMaterial({ color: styled('--bed'), side: DoubleSide }));
}
