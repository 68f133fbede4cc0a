// Everything that the page uses of the figures. Pure functions: data in, trees of shapes out.

export * from "./shape";
export * from "./numbers";
export { drawingCaption, drawingFigure, drawingView, modeMotion, suggestedFactor } from "./drawing/drawing";
export { locate, stateAt, type Located, type LocatedState } from "./drawing/locate";
export { toModel, toPixel, zoomed, type DrawingInput, type View } from "./drawing/scene";
export {
  chosenShape, criticalNear, nearestOnPath, pathChart, pathFigure, softestNear, type PathChart, type PathInput, type PathShadow,
} from "./chart/path";
export {
  branchesOf, defaultQuantities, flutterArc, isReversed, quantityLabel, rowsOfStates, stateNear, walk, type PathPoint, type PathQuantity,
  type PathResult,
} from "./chart/curves";
export { hasStiffness, softestPoint, type SoftestPoint } from "./chart/stiffness";
export {
  kSections, sectionsChart, sectionsFigure, sectionsLocate, type SectionQuantity, type SectionsChart, type SectionsInput,
} from "./chart/sections";
export { drawnLaw, lawChart, lawFigure, type LawChart, type LawInput } from "./chart/law";
export { bucklingFigure, nearestMode, type BucklingInput } from "./chart/buckling";
export {
  frequencyChart, frequencyFigure, hasFrequencies, motionsOf, nearestMotion, quadratureOf, type ChosenMotion, type FrequencyChart,
  type FrequencyInput, type Motion,
} from "./chart/frequencies";
export { nearestInSweep, sweepLine, sweepLineChart, type SweepLineChart, type SweepLineInput } from "./chart/sweep_line";
export { sweepMap, sweepMapChart, sweepMapLocate, type SweepMapChart, type SweepMapInput } from "./chart/sweep_map";
export { changesOf, changeText, curveAxes, piecesOf } from "./chart/pieces";
export { columnLabel, errorsOf, failureText, type SweepAxis, type Table } from "./chart/sweep";
export { frequencyTable, lawTable, pathTable, sectionTable, sweepTable, tableCsv, tableText, type Cell, type FigureTable } from "./tables";
